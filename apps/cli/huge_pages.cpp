// Memory of large arrays in huge pages, for the whole program: these operators stand in the place
// of the standard ones.
//
// Arrays of all texels are made and filled once each. In pages of 4 KiB the kernel is asked for
// every one of them, which takes much of a large scan's time. Only programs decide that; the
// library leaves memory to who uses it.

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#include <sys/mman.h>
#include <unistd.h>

namespace
{

constexpr size_t kLarge = size_t{1} << 20;

/// A kernel without huge pages says no, which is no error of ours.
void askForHugePages(void* memory, size_t size)
{
    const int before = errno;
    const auto page = static_cast<uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto within = reinterpret_cast<uintptr_t>(memory) % page;
    madvise(static_cast<std::byte*>(memory) - within, size + within, MADV_HUGEPAGE);
    errno = before;
}

template<class Take>
void* allocate(size_t size, const Take& take)
{
    for (;;) {
        if (void* memory = take(size == 0 ? 1 : size)) {
            if (size >= kLarge) askForHugePages(memory, size);
            return memory;
        }
        const std::new_handler handler = std::get_new_handler();
        if (handler == nullptr) throw std::bad_alloc();
        handler();
    }
}

} // namespace

void* operator new(size_t size)
{
    return allocate(size, [](size_t bytes) { return std::malloc(bytes); });
}

void* operator new(size_t size, std::align_val_t alignment)
{
    const auto multiple = static_cast<size_t>(alignment);
    return allocate(size, [&](size_t bytes) -> void* {
        const size_t whole = (bytes + multiple - 1) / multiple * multiple;
        return whole < bytes ? nullptr : std::aligned_alloc(multiple, whole);
    });
}

void operator delete(void* memory) noexcept
{
    std::free(memory);
}

void operator delete(void* memory, size_t /*size*/) noexcept
{
    std::free(memory);
}

void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept
{
    std::free(memory);
}

void operator delete(void* memory, size_t /*size*/, std::align_val_t /*alignment*/) noexcept
{
    std::free(memory);
}
