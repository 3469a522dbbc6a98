#pragma once

#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace relamp
{

/// How much of each other parts of a scan see, m^2.
class RoomSights
{
public:
    explicit RoomSights(size_t parts) : parts_(parts), sees_(parts * parts, 0.0) {}

    [[nodiscard]] size_t parts() const { return parts_; }
    void add(size_t part, size_t seen, double area) { sees_[part * parts_ + seen] += area; }
    [[nodiscard]] double ofEachOther(size_t a, size_t b) const
    {
        return sees_[a * parts_ + b] + sees_[b * parts_ + a];
    }
    /// All that a part sees.
    [[nodiscard]] double seenBy(size_t part) const
    {
        const auto row = sees_.begin() + static_cast<std::ptrdiff_t>(part * parts_);
        return std::accumulate(row, row + static_cast<std::ptrdiff_t>(parts_), 0.0);
    }
    /// `into` sees, and is seen, as both.
    void join(size_t into, size_t from)
    {
        for (size_t k = 0; k < parts_; ++k) sees_[into * parts_ + k] += sees_[from * parts_ + k];
        for (size_t k = 0; k < parts_; ++k) sees_[k * parts_ + into] += sees_[k * parts_ + from];
    }

private:
    size_t parts_;
    std::vector<double> sees_; // [part * parts + seen]
};

/// Joins parts, those first that see most of each other beside what they would by their sizes
/// alone. Of parts that see as much the first come first.
class JoinedParts
{
public:
    /// `seen`: what each part sees, m^2; parts that see nothing are left out.
    JoinedParts(RoomSights& sights, std::vector<double> seen);

    struct Two
    {
        size_t into;
        size_t from;
        double ofEachOther; // that they see, m^2
    };
    /// Joins the next two; nothing where none see each other.
    std::optional<Two> next();

private:
    struct Nearest
    {
        size_t part = 0; // of those behind it
        double near = 0.0;
    };

    [[nodiscard]] double near(size_t a, size_t b) const;
    [[nodiscard]] Nearest nearestOf(size_t a) const;
    void joinInto(size_t into, size_t from);

    RoomSights& sights_;
    std::vector<double> seen_;
    std::vector<size_t> left_;     // parts that are not joined into another, ascending
    std::vector<Nearest> nearest_; // of parts
};

} // namespace relamp
