#include "base/spill.h"

#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

namespace relamp
{
namespace
{

constexpr size_t kLeast = size_t{1} << 20; // bytes that are worth a file

/// The whole pages of memory in a range.
std::span<std::byte> wholePages(std::span<const std::byte> memory)
{
    const auto page = static_cast<uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto begin = reinterpret_cast<uintptr_t>(memory.data());
    const uintptr_t first = (begin + page - 1) / page * page;
    const uintptr_t last = (begin + memory.size()) / page * page;
    if (first >= last) return {};
    return {const_cast<std::byte*>(memory.data()) + (first - begin), last - first};
}

/// A file that no folder lists, and that is gone with its last use.
class NamelessFile
{
public:
    NamelessFile()
    {
        const char* wish = std::getenv("TMPDIR");
        std::string name = wish != nullptr && *wish != '\0' ? wish : "/var/tmp";
        name += "/relamp-XXXXXX";
        handle_ = mkostemp(name.data(), O_CLOEXEC);
        if (handle_ >= 0) unlink(name.c_str());
    }
    ~NamelessFile()
    {
        if (handle_ >= 0) close(handle_);
    }
    NamelessFile(const NamelessFile&) = delete;
    NamelessFile& operator=(const NamelessFile&) = delete;

    [[nodiscard]] int handle() const { return handle_; }

    /// Room first: where a mapped file cannot grow, whoever writes there is ended.
    [[nodiscard]] bool write(std::span<const std::byte> bytes) const
    {
        if (handle_ < 0 || posix_fallocate(handle_, 0, static_cast<off_t>(bytes.size())) != 0)
            return false;
        size_t done = 0;
        while (done < bytes.size()) {
            const ssize_t more =
                pwrite(handle_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
            if (more <= 0) return false;
            done += static_cast<size_t>(more);
        }
        return true;
    }

private:
    int handle_ = -1;
};

/// Whether all of a range is a mapped file that others see change: /proc says so.
bool isSpilled(std::span<const std::byte> pages)
{
    auto at = reinterpret_cast<uintptr_t>(pages.data());
    const uintptr_t end = at + pages.size();
    std::ifstream maps("/proc/self/maps");
    for (std::string line; at < end && std::getline(maps, line);) {
        uintptr_t first = 0;
        uintptr_t last = 0;
        char kind[5] = {};
        if (std::sscanf(line.c_str(), "%" SCNxPTR "-%" SCNxPTR " %4s", &first, &last, kind) != 3)
            return false;
        if (at < first) return false;
        if (at >= last) continue;
        if (kind[3] != 's') return false;
        at = last;
    }
    return at >= end;
}

} // namespace

bool spill(std::span<std::byte> memory)
{
    const std::span<std::byte> pages = wholePages(memory);
    if (pages.size() < kLeast) return false;
    if (isSpilled(pages)) return true;
    const NamelessFile file;
    if (!file.write(pages)) return false;
    return mmap(pages.data(), pages.size(), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED,
                file.handle(), 0) != MAP_FAILED;
}

bool needsOwnPages(std::span<const std::byte> memory)
{
#ifdef __GLIBC__
    const std::span<std::byte> pages = wholePages(memory);
    if (pages.size() < kLeast || isSpilled(pages)) return false;
    return mallopt(M_MMAP_THRESHOLD, static_cast<int>(kLeast)) == 1;
#else
    return false;
#endif
}

void willNeed(std::span<const std::byte> memory)
{
    const std::span<std::byte> pages = wholePages(memory);
    if (!pages.empty()) madvise(pages.data(), pages.size(), MADV_WILLNEED);
}

void letGo(std::span<const std::byte> memory)
{
    const std::span<std::byte> pages = wholePages(memory);
    if (!pages.empty() && isSpilled(pages)) madvise(pages.data(), pages.size(), MADV_DONTNEED);
}

void letGoOfFreed()
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

} // namespace relamp
