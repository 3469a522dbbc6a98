#pragma once

#include <string>
#include <utility>

namespace relamp
{

/// On which line of a text its parts stand, for sentences about them.
class JsonLines
{
public:
    /// `text` is JSON that can be parsed.
    explicit JsonLines(std::string text) : text_(std::move(text)) {}

    /// Line of what a path of keys and indices leads to, say "/lights/1/position": where its key
    /// or itself begins, from 1; where there is none, that of the nearest part around it. Goes
    /// through the whole text, for most texts are never asked about.
    [[nodiscard]] int at(const std::string& path) const;

private:
    std::string text_;
};

} // namespace relamp
