#include "base/spill.h"

#include <cstdint>
#include <cstdlib>
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

} // namespace

/// Private: a copy of this process, and whatever comes to lie there when this is freed, share
/// nothing.
bool spill(std::span<const std::byte> memory)
{
    const std::span<std::byte> pages = wholePages(memory);
    if (pages.size() < kLeast) return false;
    const NamelessFile file;
    if (!file.write(pages)) return false;
    return mmap(pages.data(), pages.size(), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_FIXED,
                file.handle(), 0) != MAP_FAILED;
}

void willNeed(std::span<const std::byte> memory)
{
    const std::span<std::byte> pages = wholePages(memory);
    if (!pages.empty()) madvise(pages.data(), pages.size(), MADV_WILLNEED);
}

void letGo(std::span<const std::byte> memory)
{
    const std::span<std::byte> pages = wholePages(memory);
    if (!pages.empty()) madvise(pages.data(), pages.size(), MADV_DONTNEED);
}

void letGoOfFreed()
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

} // namespace relamp
