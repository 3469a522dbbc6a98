#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// A name as a prim may have it in every version of USD: letters and digits of ASCII and '_', no
/// digit in front. All else becomes '_'; of nothing "unnamed" is made.
std::string primName(std::string_view name);

/// Names of prims that stand beside each other, of which each is given once.
class PrimNames
{
public:
    /// primName(name), with a number behind where another has it already.
    std::string take(std::string_view name);

private:
    std::set<std::string> taken_;
};

/// A text as usda has it between quotes, with the quotes. What is no UTF-8 is replaced.
std::string usdString(std::string_view text);

/// A usda file, written as it comes: what is in memory is a buffer's size. Numbers are as short as
/// they can be and still give the same float when they are read; none may be NaN or infinite.
class UsdText
{
public:
    /// Throws Error(cannotWrite), as the others do.
    explicit UsdText(const std::filesystem::path& file);

    /// A line, indented by the braces that are open.
    void line(std::string_view text);
    /// A line, and an opening brace in the next one.
    void open(std::string_view text);
    /// Likewise, with the brace in its line, as variants have it.
    void openHere(std::string_view text);
    void close();
    /// `head` = [...], of the numbers of every element.
    void array(std::string_view head, std::span<const glm::vec3> values);
    void array(std::string_view head, std::span<const glm::vec2> values);
    void array(std::string_view head, std::span<const glm::uvec3> values); // a plain list
    /// `head` = [value, value, ...]
    void array(std::string_view head, size_t count, int value);
    /// Puts what follows an array's values behind it, as its interpolation.
    void interpolation(std::string_view how);

    /// Writes what is left and closes the file.
    void finish();

private:
    struct Close
    {
        void operator()(std::FILE* stream) const { std::fclose(stream); }
    };
    template<class Vector>
    void tuples(std::string_view head, std::span<const Vector> values);
    void begin(std::string_view text);
    void put(std::string_view text);
    void put(float value);
    void put(unsigned value);
    void flush();

    std::filesystem::path file_;
    std::unique_ptr<std::FILE, Close> stream_;
    std::string buffer_;
    size_t depth_ = 0;
};

/// "(1, 0.5, 0)", and a number, as in UsdText.
std::string usd(glm::vec3 value);
std::string usd(float value);

} // namespace relamp
