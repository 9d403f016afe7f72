#include "common/app/flag.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>

#include "common/error.h"
#include "common/text/spelling.h"

namespace penumbra {
namespace {

[[noreturn]] void refuse(const char* flag, const std::string& text, const std::string& allowed) {
    throw UsageError(fmt::format("--{} {}: {}", flag, text.empty() ? "\"\"" : text, allowed));
}

template <class Number>
Number parseNumber(const char* flag, const std::string& text, Number low, Number high) {
    Number number{};
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = error == std::errc() && stop == text.data() + text.size();
    if (!whole || !(number >= low && number <= high))
        refuse(flag, text, fmt::format("must be a number from {} to {}", low, high));
    return number;
}

void requireChoice(const char* flag, const std::string& text, const std::vector<std::string>& choices) {
    if (std::find(choices.begin(), choices.end(), text) == choices.end())
        refuse(flag, text, fmt::format("must be one of {}{}", joinNames(choices), didYouMean(text, choices)));
}

std::string requireText(const char* flag, const std::string& text) {
    if (text.empty()) refuse(flag, text, "must not be empty");
    return text;
}

std::filesystem::path parsePicturePath(const std::string& text) {
    std::filesystem::path file = requireText("output", text);
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    if (extension != ".png" && extension != ".exr")
        refuse("output", text,
               "must end in .png (8 bits, for looking at) or .exr (linear float, for measuring)");
    return file;
}

std::vector<std::string> viewNames(const ChapterInfo& info) {
    std::vector<std::string> names;
    for (const ViewInfo& view : info.views) names.push_back(view.name);
    names.insert(names.end(), {"truth", "error"});
    return names;
}

using Flags = std::vector<Flag>;
constexpr auto switchFlag = Flag::Value::none;
constexpr auto valued = Flag::Value::required;

void addPictureFlags(Flags& flags, const ChapterInfo& info, Options& o) {
    const char* group = "The picture";
    flags.push_back({"scene", "NAME|FILE", group,
                     "a scene of assets/ by name, or any .gltf or .glb file (default courtyard)", valued,
                     [&o](const std::string& t) { o.scene = requireText("scene", t); }});
    flags.push_back({"camera", "INDEX", group, "which camera of the scene (default 0)", valued,
                     [&o](const std::string& t) { o.camera = parseNumber("camera", t, 0, 9999); }});
    flags.push_back({"size", "WxH", group,
                     "picture size in pixels, 1x1 to 16384x16384 (default 512x512; a window 1280x800)",
                     valued, [&o](const std::string& t) { o.size = o.windowSize = parseSize(t); }});
    flags.push_back({"view", "NAME", group, "which image; see Views below (default color, also called lit)",
                     valued, [&o, names = viewNames(info)](const std::string& t) {
                         const std::string view = t == "lit" ? "color" : t;
                         requireChoice("view", view, names);
                         o.view = view;
                     }});
    flags.push_back(
        {"antialias", "N", group, "render N x N larger and average, 1 to 16 (default 1: one sample a pixel)",
         valued,
         [&o](const std::string& t) { o.antialias = parseNumber("antialias", t, 1, largestAntialias); }});
    flags.push_back({"exposure", "EV|auto", group,
                     "brightness of a .png in stops, -20 to 20, relative to auto (default auto: "
                     "a white surface facing the light is white)",
                     valued, [&o](const std::string& t) {
                         if (t == "auto") {
                             o.exposureEv.reset();
                         } else {
                             o.exposureEv = parseNumber("exposure", t, -20.0, 20.0);
                         }
                     }});
    flags.push_back({"seed", "N", group, "every random pattern follows from it (default 1)", valued,
                     [&o](const std::string& t) {
                         o.seed = parseNumber("seed", t, 0u, std::numeric_limits<std::uint32_t>::max());
                     }});
}

void addOutputFlags(Flags& flags, Options& o) {
    const char* group = "Files and figures (each of these implies --headless)";
    flags.push_back({"output", "FILE", group,
                     "write the view: .png (tone-mapped, sRGB) or .exr (linear float); folders are made",
                     valued, [&o](const std::string& t) { o.output = parsePicturePath(t); }});
    flags.push_back({"compare-truth", "", group,
                     "compute the exact answer for this picture and report the error", switchFlag,
                     [&o](const std::string&) { o.compareTruth = true; }});
    flags.push_back({"report", "FILE", group, "write time, work and error as JSON; - for standard output",
                     valued, [&o](const std::string& t) { o.report = requireText("report", t); }});
    flags.push_back({"runs", "N", group, "timed frames after one to warm up, 1 to 10000 (default 1)", valued,
                     [&o](const std::string& t) { o.runs = parseNumber("runs", t, 1, 10000); }});
    flags.push_back({"pass-times", "", group, "also time each pass by itself, in as many further frames",
                     switchFlag, [&o](const std::string&) { o.passTimes = true; }});
    flags.push_back({"still", "", group,
                     "time frames in which nothing moves, so that maps may be kept between them", switchFlag,
                     [&o](const std::string&) { o.still = true; }});
}

Backend parseBackend(const std::string& text) {
    requireChoice("backend", text, {"auto", "window", "osmesa", "egl"});
    for (const Backend backend : {Backend::window, Backend::osmesa, Backend::egl})
        if (text == backendName(backend)) return backend;
    return Backend::automatic;
}

void addProgramFlags(Flags& flags, Options& o) {
    const char* group = "The program";
    flags.push_back({"headless", "", group, "no window; implied when there is no display", switchFlag,
                     [&o](const std::string&) { o.headless = true; }});
    flags.push_back({"backend", "NAME", group,
                     "OpenGL from auto, window, osmesa or egl (default auto: a window, else OSMesa, "
                     "else EGL)",
                     valued, [&o](const std::string& t) { o.backend = parseBackend(t); }});
    flags.push_back({"api", "NAME", group,
                     "desktop (OpenGL 3.3 core) or es (OpenGL ES 3.0) (default desktop)", valued,
                     [&o](const std::string& t) {
                         requireChoice("api", t, {"desktop", "es"});
                         o.api = t == "es" ? Api::es : Api::desktop;
                     }});
    flags.push_back({"quiet", "", group, "no summary and no progress; errors are still printed", switchFlag,
                     [&o](const std::string&) { o.quiet = true; }});
    flags.push_back(
        {"list-parameters", "", group, "print this chapter's parameters as JSON", switchFlag, {}});
    flags.push_back({"list-skips", "", group, "print this chapter's skips as JSON", switchFlag, {}});
    flags.push_back({"version", "", group, "print the version", switchFlag, {}});
    flags.push_back({"help", "", group, "print this", switchFlag, {}});
}

void addSkipFlags(Flags& flags, Skips& skips) {
    const char* group = "What is skipped (the picture stays the same to the bit, and only time is saved)";
    flags.push_back({"no-skip", "NAME", group,
                     "do this work all the same; see Skips below; can be given several times", valued,
                     [&skips](const std::string& t) { skips.switchOff(t); }, true});
    flags.push_back({"skip-none", "", group, "do all that work: every skip is off", switchFlag,
                     [&skips](const std::string&) { skips.switchAllOff(); }});
}

std::string parameterHelp(const Parameter& p) {
    const std::string unit = p.unit.empty() ? "" : " " + p.unit;
    std::string allowed;
    if (!p.choices.empty()) {
        allowed = fmt::format("{}{} (default {})", joinNames(p.choices), p.orFile ? " or FILE" : "",
                              std::get<std::string>(p.defaultValue));
    } else if (const bool* value = std::get_if<bool>(&p.defaultValue)) {
        allowed = fmt::format("on or off (default {})", *value ? "on" : "off");
    } else {
        const double standard =
            p.defaultValue.index() == 0 ? std::get<int>(p.defaultValue) : std::get<float>(p.defaultValue);
        allowed = fmt::format("{} to {}{} (default {})", shortNumber(p.low), shortNumber(p.high), unit,
                              shortNumber(standard));
    }
    return fmt::format("{} [{}]", p.help, allowed);
}

void addParameterFlags(Flags& flags, Parameters& parameters) {
    static const char* const valueNames[] = {"INT", "NUMBER", "on|off", "NAME"};
    for (const Parameter& p : parameters.all()) {
        const bool isSwitch = std::holds_alternative<bool>(p.defaultValue);
        flags.push_back({p.name, valueNames[p.defaultValue.index()], "Parameters of this chapter",
                         parameterHelp(p), isSwitch ? Flag::Value::optional : valued,
                         [&parameters, name = p.name, isSwitch](const std::string& t) {
                             parameters.set(name, isSwitch && t.empty() ? "on" : t);
                         }});
    }
}

}  // namespace

std::vector<Flag> chapterFlags(const ChapterInfo& info, Parameters& parameters, Options& options) {
    Flags flags;
    addPictureFlags(flags, info, options);
    addOutputFlags(flags, options);
    addProgramFlags(flags, options);
    addSkipFlags(flags, parameters.skips());
    addParameterFlags(flags, parameters);
    return flags;
}

}  // namespace penumbra
