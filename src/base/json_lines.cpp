#include "base/json_lines.h"

#include <iterator>
#include <vector>

#include <nlohmann/json.hpp>

namespace relamp
{
namespace
{

using nlohmann::json;

/// Walks over a text and counts its lines.
class CountingIterator
{
public:
    // NOLINTBEGIN(readability-identifier-naming): the standard's names
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;
    // NOLINTEND(readability-identifier-naming)

    CountingIterator(const char* at, int* line) : at_(at), line_(line) {}

    reference operator*() const { return *at_; }
    CountingIterator& operator++()
    {
        if (*at_ == '\n' && line_ != nullptr) ++*line_;
        ++at_;
        return *this;
    }
    bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
    bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

private:
    const char* at_;
    int* line_;
};

/// Finds the line of a path, or of the nearest part around it: the last that is met on the way.
class LineSearch : public nlohmann::json_sax<json>
{
public:
    LineSearch(const int& line, const std::string& wanted) : line_(line), wanted_(wanted + "/") {}

    [[nodiscard]] int found() const { return found_; }

    bool null() override { return item(); }
    bool boolean(bool) override { return item(); }
    bool number_integer(number_integer_t) override { return item(); }
    bool number_unsigned(number_unsigned_t) override { return item(); }
    bool number_float(number_float_t, const string_t&) override { return item(); }
    bool string(string_t&) override { return item(); }
    bool binary(binary_t&) override { return item(); }
    bool start_object(size_t) override { return open(false); }
    bool end_object() override { return close(); }
    bool start_array(size_t) override { return open(true); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override
    {
        parts_.back().path = parts_.back().base + "/" + name;
        note(parts_.back().path);
        return true;
    }
    bool parse_error(size_t, const std::string&, const nlohmann::detail::exception&) override
    {
        return false;
    }

private:
    struct Part
    {
        std::string base; // path of the object or list
        std::string path; // of what is in it now
        bool isList;
        size_t next = 0;
    };

    bool item()
    {
        if (parts_.empty() || !parts_.back().isList) return true;
        Part& list = parts_.back();
        list.path = list.base + "/" + std::to_string(list.next++);
        note(list.path);
        return true;
    }
    bool open(bool isList)
    {
        item();
        const std::string base = parts_.empty() ? "" : parts_.back().path;
        parts_.push_back({base, base, isList});
        return true;
    }
    bool close()
    {
        parts_.pop_back();
        return true;
    }

    /// Paths on the way to the one that is looked for get longer.
    void note(const std::string& path)
    {
        if (path.size() <= length_ || !wanted_.starts_with(path + "/")) return;
        length_ = path.size();
        found_ = line_;
    }

    const int& line_;
    std::string wanted_;
    size_t length_ = 0;
    int found_ = 1;
    std::vector<Part> parts_;
};

} // namespace

int JsonLines::at(const std::string& path) const
{
    int line = 1;
    LineSearch search(line, path);
    json::sax_parse(CountingIterator(text_.data(), &line),
                    CountingIterator(text_.data() + text_.size(), nullptr), &search);
    return search.found();
}

} // namespace relamp
