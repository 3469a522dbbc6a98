#pragma once

#include <map>
#include <string>
#include <string_view>

namespace relamp
{

/// On which line of a text its parts stand, for sentences about them.
class JsonLines
{
public:
    /// `text` is JSON that can be parsed.
    explicit JsonLines(std::string_view text);

    /// Line of what a path of keys and indices leads to, say "/lights/1/position": where its key
    /// or itself begins, from 1; where there is none, that of the nearest part around it.
    [[nodiscard]] int at(std::string path) const;

private:
    std::map<std::string, int> lineOf_;
};

} // namespace relamp
