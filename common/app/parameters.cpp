#include "common/app/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/text/spelling.h"

namespace penumbra {
namespace {

using Json = nlohmann::ordered_json;

std::string withUnit(const std::string& unit) {
    return unit.empty() ? "" : " " + unit;
}

[[noreturn]] void refuse(const Parameter& parameter, const std::string& text, const std::string& allowed) {
    throw UsageError(fmt::format("--{} {}: {}", parameter.name, text.empty() ? "\"\"" : text, allowed));
}

std::string rangeText(const Parameter& parameter, const char* kind) {
    return fmt::format("must be {} from {} to {}{}", kind, shortNumber(parameter.low),
                       shortNumber(parameter.high), withUnit(parameter.unit));
}

/// The whole text as a number, or nothing.
template <class Number>
bool readNumber(const std::string& text, Number& number) {
    const char* begin = text.c_str() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
    const char* end = text.c_str() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, number);
    return error == std::errc() && stop == end && begin != end;
}

void setFromText(const Parameter& p, int& value, const std::string& text) {
    long long number = 0;
    if (!readNumber(text, number) || number < p.low || number > p.high)
        refuse(p, text, rangeText(p, "a whole number"));
    value = int(number);
}

void setFromText(const Parameter& p, float& value, const std::string& text) {
    double number = 0.0;
    const bool isNumber = readNumber(text, number);
    // Compared as float: the limit 0.1f is a little more than 0.1, and "0.1" must be allowed. NaN is inside
    // no range.
    const float rounded = float(number);
    if (!isNumber || !(rounded >= float(p.low) && rounded <= float(p.high)))
        refuse(p, text, rangeText(p, "a number"));
    value = rounded;
}

void setFromText(const Parameter& p, bool& value, const std::string& text) {
    const auto isOneOf = [&](std::initializer_list<const char*> words) {
        return std::find(words.begin(), words.end(), text) != words.end();
    };
    if (isOneOf({"true", "on", "yes", "1"})) {
        value = true;
    } else if (isOneOf({"false", "off", "no", "0"})) {
        value = false;
    } else {
        refuse(p, text, "must be on or off");
    }
}

void setFromText(const Parameter& p, std::string& value, const std::string& text) {
    const bool file = p.orFile && text.find_first_of("./") != std::string::npos;
    if (!file && std::find(p.choices.begin(), p.choices.end(), text) == p.choices.end())
        refuse(p, text,
               fmt::format("must be one of {}{}{}", joinNames(p.choices), p.orFile ? ", or a file" : "",
                           didYouMean(text, p.choices)));
    value = text;
}

/// The double whose shortest decimal form is that of the float: 0.1f is reported as 0.1, not 0.10000000149.
double shortest(float value) {
    return std::stod(fmt::format("{}", value));
}

Json toJsonValue(float value) {
    return shortest(value);
}
template <class T>
Json toJsonValue(const T& value) {
    return value;
}

Json currentValue(const Parameter& parameter) {
    return std::visit([](const auto* value) { return toJsonValue(*value); }, parameter.value);
}

Json description(const Parameter& parameter) {
    static const char* const typeNames[] = {"int", "float", "bool", "choice"};
    Json entry{{"name", parameter.name}, {"type", typeNames[parameter.value.index()]}};
    entry["unit"] = parameter.unit;
    if (parameter.defaultValue.index() == 0) entry["range"] = {int(parameter.low), int(parameter.high)};
    if (parameter.defaultValue.index() == 1)
        entry["range"] = {shortest(float(parameter.low)), shortest(float(parameter.high))};
    if (!parameter.choices.empty()) entry["choices"] = parameter.choices;
    if (parameter.orFile) entry["or_file"] = true;
    entry["default"] =
        std::visit([](const auto& value) { return toJsonValue(value); }, parameter.defaultValue);
    entry["help"] = parameter.help;
    return entry;
}

/// Declaration mistakes are the chapter author's: found the first time the program runs.
void requireGoodDeclaration(const std::vector<Parameter>& existing, const Parameter& added,
                            bool defaultAllowed) {
    const bool taken = std::any_of(existing.begin(), existing.end(),
                                   [&](const Parameter& other) { return other.name == added.name; });
    if (taken) throw Error(fmt::format("parameter {} is declared twice", added.name));
    if (!defaultAllowed)
        throw Error(fmt::format("the default of parameter {} is not among its allowed values", added.name));
}

}  // namespace

std::string shortNumber(double value) {
    return fmt::format("{}", float(value));
}

void Parameters::add(const std::string& name, int& value, int low, int high, const std::string& unit,
                     const std::string& help) {
    const Parameter added{name, help, unit, &value, double(low), double(high), {}, value};
    requireGoodDeclaration(parameters_, added, value >= low && value <= high);
    parameters_.push_back(added);
}

void Parameters::add(const std::string& name, float& value, float low, float high, const std::string& unit,
                     const std::string& help) {
    const Parameter added{name, help, unit, &value, double(low), double(high), {}, value};
    requireGoodDeclaration(parameters_, added, value >= low && value <= high);
    parameters_.push_back(added);
}

void Parameters::add(const std::string& name, bool& value, const std::string& help) {
    const Parameter added{name, help, "", &value, 0.0, 1.0, {}, value};
    requireGoodDeclaration(parameters_, added, true);
    parameters_.push_back(added);
}

void Parameters::add(const std::string& name, std::string& value, std::vector<std::string> choices,
                     const std::string& help) {
    const bool known = std::find(choices.begin(), choices.end(), value) != choices.end();
    const Parameter added{name, help, "", &value, 0.0, 0.0, std::move(choices), value};
    requireGoodDeclaration(parameters_, added, known);
    parameters_.push_back(added);
}

void Parameters::addOrFile(const std::string& name, std::string& value, std::vector<std::string> choices,
                           const std::string& help) {
    add(name, value, std::move(choices), help);
    parameters_.back().orFile = true;
}

void Parameters::set(const std::string& name, const std::string& text) {
    for (const Parameter& parameter : parameters_) {
        if (parameter.name != name) continue;
        std::visit([&](auto* value) { setFromText(parameter, *value, text); }, parameter.value);
        return;
    }
    std::vector<std::string> names;
    for (const Parameter& parameter : parameters_) names.push_back(parameter.name);
    throw UsageError(fmt::format("--{}: unknown parameter{}", name, didYouMean(name, names)));
}

std::string Parameters::toJson(bool valuesOnly) const {
    Json result = valuesOnly ? Json::object() : Json::array();
    for (const Parameter& parameter : parameters_) {
        if (valuesOnly) {
            result[parameter.name] = currentValue(parameter);
        } else {
            result.push_back(description(parameter));
        }
    }
    return result.dump(2);
}

}  // namespace penumbra
