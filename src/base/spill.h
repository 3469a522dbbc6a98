#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace relamp
{

/// Copies large memory to a temporary file, which is then mapped in its place: what points there
/// stays good, and so does whatever frees it. Its pages come back one by one as they are read, and
/// the system may take them again; what is changed is in RAM alone. False where it stays as it is,
/// for it is small or there is no room for a file. The folder is $TMPDIR or /var/tmp. Nobody may
/// write there meanwhile.
bool spill(std::span<const std::byte> memory);

/// Spilled memory that will be read in any order is read in one go.
void willNeed(std::span<const std::byte> memory);

/// Memory for which spill() said true, and that was not changed since, leaves RAM until it is read
/// again. Of anything else, what it holds would be lost.
void letGo(std::span<const std::byte> memory);

/// What was freed since, and is kept for what comes next, leaves RAM.
void letGoOfFreed();

/// Whether an array lies in a file. A copy of it does not.
class InFile
{
public:
    InFile() = default;
    InFile(const InFile&) noexcept {}
    InFile(InFile&& other) noexcept : is_(std::exchange(other.is_, false)) {}
    InFile& operator=(const InFile&) noexcept
    {
        is_ = false;
        return *this;
    }
    InFile& operator=(InFile&& other) noexcept
    {
        is_ = std::exchange(other.is_, false);
        return *this;
    }
    InFile& operator=(bool is) noexcept
    {
        is_ = is;
        return *this;
    }
    operator bool() const { return is_; }

private:
    bool is_ = false;
};

template<class T>
bool spill(const std::vector<T>& values)
{
    return spill(std::as_bytes(std::span(values)));
}

template<class T>
void willNeed(const std::vector<T>& values)
{
    willNeed(std::as_bytes(std::span(values)));
}

template<class T>
void letGo(const std::vector<T>& values)
{
    letGo(std::as_bytes(std::span(values)));
}

} // namespace relamp
