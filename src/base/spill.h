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
/// meanwhile. Its pages must leave with it when it is freed (needsOwnPages): what came to lie in
/// them next would be shared with copies of this process.
bool spill(std::span<std::byte> memory);

/// Whether memory that is to be spilled has to be made anew first, for it may lie among others, as
/// large as it is: a program may keep what was freed. From then on all that is made and worth a
/// file has pages of its own.
bool needsOwnPages(std::span<const std::byte> memory);

/// Spilled memory that will be read in any order is read in one go.
void willNeed(std::span<const std::byte> memory);

/// Spilled memory that was used and will not be for a while leaves RAM; what it holds stays. Of
/// other memory, nothing happens.
void letGo(std::span<const std::byte> memory);

/// What was freed since, and is kept for what comes next, leaves RAM.
void letGoOfFreed();

/// What pointed to them is no longer good.
template<class T>
bool spill(std::vector<T>& values)
{
    if (needsOwnPages(std::as_bytes(std::span(values)))) std::vector<T>(values).swap(values);
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
