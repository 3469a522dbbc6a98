#include "image/other_formats.h"

#include "base/fail.h"

#include <dlfcn.h>
#include <tbb/global_control.h>

namespace relamp
{
namespace
{

constexpr const char* kLibrary = "librelamp_formats.so"; // beside relamp's own: see src/CMakeLists

ReadWithOpenImageIo* load()
{
    void* library = dlopen(kLibrary, RTLD_LAZY | RTLD_LOCAL);
    void* found = library != nullptr ? dlsym(library, kReadWithOpenImageIo) : nullptr;
    if (found == nullptr)
        fail(ErrorCode::unsupported, kLibrary,
             fmt::format("cannot be loaded, and without it only JPEG and PNG are read; install "
                         "relamp again ({})",
                         dlerror()));
    return reinterpret_cast<ReadWithOpenImageIo*>(found);
}

} // namespace

Picture readOtherFormat(std::span<const std::byte> bytes, const std::string& format,
                        const HeaderCheck& check)
{
    static ReadWithOpenImageIo* const read = load();
    const size_t threads =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    OtherFormat file{bytes, format, check, static_cast<int>(threads), {}, {}};
    read(file);
    if (!file.failure.empty()) throw UndecodablePicture(file.failure);
    return std::move(file.picture);
}

} // namespace relamp
