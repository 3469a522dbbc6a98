#include "shading/room_sights.h"

#include <algorithm>

namespace relamp
{

JoinedParts::JoinedParts(RoomSights& sights, std::vector<double> seen)
    : sights_(sights), seen_(std::move(seen)), nearest_(seen_.size())
{
    for (size_t part = 0; part < seen_.size(); ++part)
        if (seen_[part] > 0.0) left_.push_back(part);
    for (const size_t part : left_) nearest_[part] = nearestOf(part);
}

double JoinedParts::near(size_t a, size_t b) const
{
    return sights_.ofEachOther(a, b) / (seen_[a] * seen_[b]);
}

JoinedParts::Nearest JoinedParts::nearestOf(size_t a) const
{
    Nearest best;
    for (auto b = std::ranges::upper_bound(left_, a); b != left_.end(); ++b)
        if (const double found = near(a, *b); found > best.near) best = {*b, found};
    return best;
}

std::optional<JoinedParts::Two> JoinedParts::next()
{
    if (left_.empty()) return std::nullopt;
    const size_t into =
        *std::ranges::max_element(left_, {}, [&](size_t part) { return nearest_[part].near; });
    if (nearest_[into].near <= 0.0) return std::nullopt;
    const size_t from = nearest_[into].part;
    const Two two{into, from, sights_.ofEachOther(into, from)};
    joinInto(into, from);
    return two;
}

/// Only what was nearest to one of the two has to look at all others again.
void JoinedParts::joinInto(size_t into, size_t from)
{
    sights_.join(into, from);
    seen_[into] += seen_[from];
    left_.erase(std::ranges::lower_bound(left_, from));
    for (const size_t a : left_) {
        const size_t before = nearest_[a].part;
        const bool isLost = nearest_[a].near > 0.0 && (before == into || before == from);
        if (a == into || isLost)
            nearest_[a] = nearestOf(a);
        else if (a < into)
            if (const double found = near(a, into);
                found > nearest_[a].near || (found == nearest_[a].near && into < before))
                nearest_[a] = {into, found};
    }
}

} // namespace relamp
