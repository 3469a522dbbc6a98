#pragma once

#include "gpu/device.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace relamp
{

/// What pages may take of a device's memory, in bytes; the rest is for the room itself, and for
/// others.
inline uint64_t usualBudget(const gpu::Device& device)
{
    return device.description().memory / 5 * 4;
}

/// Pages on a device. They stay as long as all fit into a budget; else they take turns.
template<class Page>
class ResidentPages
{
public:
    using BytesOf = std::function<uint64_t(size_t page)>;
    using Make = std::function<std::unique_ptr<Page>(size_t page)>;

    /// `budget` is in bytes, 0: the usual.
    ResidentPages(const gpu::Device& device, size_t count, uint64_t budget, BytesOf bytesOf,
                  Make make)
        : budget_(budget != 0 ? budget : usualBudget(device)), bytesOf_(std::move(bytesOf)),
          make_(std::move(make)), pages_(count)
    {}

    [[nodiscard]] size_t count() const { return pages_.size(); }
    /// Brings a page in where it is not there, and others out where they have to make room.
    Page& operator[](size_t page)
    {
        if (pages_[page]) return *pages_[page];
        uint64_t bytes = bytesOf_(page);
        for (size_t p = 0; p < pages_.size(); ++p)
            if (pages_[p]) bytes += bytesOf_(p);
        for (size_t p = 0; p < pages_.size() && bytes > budget_; ++p) {
            if (!pages_[p]) continue;
            bytes -= bytesOf_(p);
            pages_[p].reset();
        }
        pages_[page] = make_(page);
        return *pages_[page];
    }

    /// A page that is there.
    const Page& operator[](size_t page) const { return *pages_[page]; }

private:
    uint64_t budget_;
    BytesOf bytesOf_;
    Make make_;
    std::vector<std::unique_ptr<Page>> pages_; // null: not on the device
};

} // namespace relamp
