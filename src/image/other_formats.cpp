#include "image/other_formats.h"

#include "image/write_image.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>

#include <OpenEXR/ImfThreading.h>
#include <dlfcn.h>
#include <tbb/global_control.h>

namespace relamp
{
namespace
{

constexpr const char* kLibrary = "librelamp_formats.so"; // beside relamp's own: see src/CMakeLists
constexpr size_t kStacks = size_t{16} << 20; // of a thread of OpenImageIO's and one of OpenEXR's
constexpr int kMostExrThreads = 512;         // that OpenImageIO knows of; ThreadLimit takes half
constexpr int kCopies = 2;                   // of all samples: WebP and TGA are decoded as a whole
constexpr double kSecondsPerByte = 2e-8;     // the slowest, WebP without loss, needs a tenth

/// Null where it is not there.
void* offered(const char* name)
{
    void* library = dlopen(kLibrary, RTLD_LAZY | RTLD_LOCAL);
    return library != nullptr ? dlsym(library, name) : nullptr;
}

ReadWithOpenImageIo* load()
{
    void* found = offered(kReadWithOpenImageIo);
    if (found == nullptr)
        fail(ErrorCode::unsupported, kLibrary,
             fmt::format("cannot be loaded, and without it only JPEG and PNG are read; install "
                         "relamp again ({})",
                         dlerror()));
    return reinterpret_cast<ReadWithOpenImageIo*>(found);
}

// ---- in the child

/// The numbers of a header that its samples need.
using HeaderNumbers = std::array<int64_t, 7>;

HeaderNumbers numbersOf(const PictureHeader& header)
{
    return {header.width,     header.height,     header.channels,  header.alphaChannel,
            header.isOfBytes, header.isOfHalves, header.isOfFloats};
}

/// What the standard library throws within OpenImageIO comes as text about C++. All of it is about
/// sizes beyond any memory.
bool isOfCxx(const std::string& failure)
{
    return failure.find("::") != std::string::npos;
}

void readAndSend(ReadWithOpenImageIo* read, const PictureFile& file, int threads,
                 const HeaderCheck& check, const ByteSink& send)
{
    // OpenEXR's threads are the parent's and not here, but it counts on them, and would wait for
    // them to end if it were to have fewer: it is given more.
    const int exrThreads = std::min(Imf::globalThreadCount() + threads, kMostExrThreads);
    Imf::setGlobalThreadCount(exrThreads);
    const auto sendHeader = [&](const PictureHeader& header) {
        check(header);
        const HeaderNumbers numbers = numbersOf(header);
        send(std::as_bytes(std::span(numbers)));
    };
    OtherFormat other{file, threads, exrThreads, sendHeader, send, {}};
    read(other);
    if (isOfCxx(other.failure)) throw std::bad_alloc();
    if (!other.failure.empty()) undecodable(file, other.failure);
}

// ---- in this process

/// Puts a picture together from what comes, which may have been overrun before it was sent.
class PictureTaker
{
public:
    PictureTaker(const PictureFile& file, const HeaderCheck& check)
        : file_(file), check_(check), left_(std::as_writable_bytes(std::span(numbers_)))
    {}

    void take(std::span<const std::byte> piece)
    {
        while (!piece.empty()) {
            const size_t count = std::min(piece.size(), left_.size());
            if (count == 0) undecodable(file_, "there are more pixels than its header says");
            std::memcpy(left_.data(), piece.data(), count);
            piece = piece.subspan(count);
            left_ = left_.subspan(count);
            if (left_.empty() && picture_.header.width == 0) makeRoom();
        }
    }

    Picture whole()
    {
        if (picture_.header.width == 0 || !left_.empty())
            undecodable(file_, "there are fewer pixels than its header says");
        return std::move(picture_);
    }

private:
    void makeRoom()
    {
        PictureHeader& header = picture_.header;
        header.width = numbers_[0];
        header.height = numbers_[1];
        header.channels = static_cast<int>(numbers_[2]);
        header.alphaChannel = static_cast<int>(numbers_[3]);
        header.isOfBytes = numbers_[4] != 0;
        header.isOfHalves = numbers_[5] != 0;
        header.isOfFloats = numbers_[6] != 0;
        check_(header);
        if (header.isOfBytes)
            makeRoomFor<uint8_t>();
        else if (header.isOfHalves)
            makeRoomFor<uint16_t>();
        else
            makeRoomFor<float>();
    }

    template<class Sample>
    void makeRoomFor()
    {
        const PictureHeader& header = picture_.header;
        auto& samples = picture_.samples.emplace<std::vector<Sample>>(
            static_cast<size_t>(header.width * header.height * header.channelsToRead()));
        left_ = std::as_writable_bytes(std::span(samples));
    }

    const PictureFile& file_;
    const HeaderCheck& check_;
    HeaderNumbers numbers_{};
    Picture picture_;
    std::span<std::byte> left_; // of the numbers, then of the samples: what has yet to come
};

} // namespace

Picture readOtherFormat(const PictureFile& file, int64_t mostBytes, const HeaderCheck& check)
{
    static ReadWithOpenImageIo* const read = load();
    const size_t threads =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    ChildLimits limits;
    limits.memory += kCopies * static_cast<size_t>(mostBytes) + kStacks * threads;
    limits.seconds = 2.0 + kSecondsPerByte * static_cast<double>(mostBytes);
    PictureTaker taker(file, check);
    runInChild(
        [&](const ByteSink& send) {
            readAndSend(read, file, static_cast<int>(threads), check, send);
        },
        [&](std::span<const std::byte> piece) { taker.take(piece); }, limits,
        {file.name, "The picture is damaged; save it again, best as PNG"}, unwatched());
    return taker.whole();
}

std::vector<uint8_t> encodeWebp(std::span<const uint8_t> rgb, Size size, int quality,
                                const Progress& progress)
{
    constexpr int kLargestSide = 16383;     // of the format
    constexpr double kSecondsOfByte = 2e-5; // of what is encoded, at most
    constexpr size_t kMemoryOfByte = 16;
    static auto* const write =
        reinterpret_cast<WriteWithOpenImageIo*>(offered(kWriteWithOpenImageIo));
    if (write == nullptr || std::max(size.width, size.height) > kLargestSide) return {};
    ChildLimits limits;
    limits.memory += kMemoryOfByte * rgb.size();
    limits.seconds += kSecondsOfByte * static_cast<double>(rgb.size());
    std::vector<uint8_t> bytes;
    try {
        runInChild(
            [&](const ByteSink& send) {
                WebpFile file{rgb, size.width, size.height, quality, send, {}};
                write(file);
            },
            [&](std::span<const std::byte> piece) {
                const auto* begin = reinterpret_cast<const uint8_t*>(piece.data());
                bytes.insert(bytes.end(), begin, begin + piece.size());
            },
            limits, {"a picture", "It is written otherwise"}, progress);
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) throw;
        return {};
    }
    return bytes;
}

} // namespace relamp
