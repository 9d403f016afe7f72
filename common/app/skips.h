// Work that cannot change the picture and is not done: each kind has a name, and can be switched off to see
// what it saves.
#pragma once

#include <string>
#include <vector>

namespace penumbra {

/// One kind of work that is left out. A constant beside the code that leaves it out, declared by every
/// chapter that may come by there: it becomes a name of --no-skip, an entry of --help, a row of the benchmark
/// and a case of the test that the picture stays the same to the bit.
struct Skip {
    const char* name;  ///< kebab-case
    const char*
        counter;  ///< of WorkCounters: rises when the skip is off and had something to leave out; "": none
    const char* help;  ///< one line: what is left out, and why that cannot change the picture
};

/// The skips of a chapter, and which of them are on: all, unless switched off.
class Skips {
 public:
    /// Declaring the same constant again changes nothing: two techniques of a chapter may share it. Throws
    /// Error if another has its name.
    void declare(const Skip& skip);

    /// Is it on? Throws Error if it was not declared: --no-skip would not know it.
    bool operator()(const Skip& skip) const;
    /// Throws UsageError, with the nearest name, if there is no such skip.
    void switchOff(const std::string& name);
    void switchAllOff();

    std::vector<Skip> all() const;
    /// Names of those that are off.
    std::vector<std::string> off() const;
    /// --skip-none: none is left on, and there is one.
    bool allOff() const;
    /// For --list-skips: an array of name, counter and help.
    std::string toJson() const;

 private:
    struct Entry {
        const Skip* skip;
        bool on = true;
    };
    std::vector<Entry> entries_;  // a handful: looked through by address
};

}  // namespace penumbra
