// Memory of large arrays in huge pages, for the whole program: this operator new stands in the
// place of the standard one.
//
// Arrays of all texels are made and filled once each. In pages of 4 KiB the kernel is asked for
// every one of them, which is an eighth of the time of a large scan. Only programs decide that; the
// library leaves memory to who uses it.

#include <cstdint>
#include <cstdlib>
#include <new>

#include <sys/mman.h>
#include <unistd.h>

namespace
{

constexpr size_t kLarge = size_t{1} << 20;

void* allocate(size_t size)
{
    void* memory = std::malloc(size == 0 ? 1 : size);
    if (size < kLarge || memory == nullptr) return memory;
    const auto page = static_cast<uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto begin = reinterpret_cast<uintptr_t>(memory) / page * page;
    madvise(reinterpret_cast<void*>(begin), size, MADV_HUGEPAGE); // a kernel without them says no
    return memory;
}

} // namespace

void* operator new(size_t size)
{
    for (;;) {
        if (void* memory = allocate(size)) return memory;
        const std::new_handler handler = std::get_new_handler();
        if (handler == nullptr) throw std::bad_alloc();
        handler();
    }
}

void operator delete(void* memory) noexcept
{
    std::free(memory);
}

void operator delete(void* memory, size_t /*size*/) noexcept
{
    std::free(memory);
}
