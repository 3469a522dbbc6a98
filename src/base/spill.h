#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace relamp
{

/// Moves large memory to a temporary file, which is then mapped in its place: what points there
/// stays good, and so does whatever frees it. Its pages come back one by one as they are read or
/// written, and the system may take them again. False where it stays as it is, for it is small or
/// there is no room for a file. The folder is $TMPDIR or /var/tmp. Nobody may write there
/// meanwhile.
bool spill(std::span<std::byte> memory);

/// Spilled memory that will be read in any order is read in one go.
void willNeed(std::span<const std::byte> memory);

/// Spilled memory that was used and will not be for a while leaves RAM; what it holds stays. Of
/// other memory, nothing happens.
void letGo(std::span<const std::byte> memory);

/// What was freed since, and is kept for what comes next, leaves RAM.
void letGoOfFreed();

template<class T>
bool spill(std::vector<T>& values)
{
    return spill(std::as_writable_bytes(std::span(values)));
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
