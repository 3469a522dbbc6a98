#include "image/jpeg.h"

#include "base/fail.h"
#include "image/write_image.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <jpeglib.h>

namespace relamp
{
namespace
{

constexpr int kQuality = 95; // no eye tells it from the picture
// Progressive files have about ten. A few bytes are a scan that goes over the whole picture, so a
// small file of many would keep us busy for hours.
constexpr int kMostScans = 100;

/// libjpeg says what is wrong and jumps to the last setjmp. So a function that calls setjmp keeps
/// nothing that has a destructor, and returns false when it is jumped to.
struct Failure
{
    jpeg_error_mgr manager{}; // first: libjpeg knows no more of this
    std::jmp_buf back{};
    std::array<char, JMSG_LENGTH_MAX> message{};

    jpeg_error_mgr* start()
    {
        jpeg_std_error(&manager);
        manager.error_exit = onError;
        manager.emit_message = onWarning;
        return &manager;
    }

    [[noreturn]] static void onError(j_common_ptr jpeg)
    {
        auto* failure = reinterpret_cast<Failure*>(jpeg->err);
        failure->manager.format_message(jpeg, failure->message.data());
        std::longjmp(failure->back, 1);
    }
    static void onWarning(j_common_ptr /*jpeg*/, int /*level*/) {}

    static void onProgress(j_common_ptr jpeg)
    {
        if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= kMostScans) return;
        auto* failure = reinterpret_cast<Failure*>(jpeg->err);
        constexpr std::string_view kTooMany = "it has more scans than any picture needs";
        std::copy(kTooMany.begin(), kTooMany.end(), failure->message.begin());
        std::longjmp(failure->back, 1);
    }
};

bool halvesColor(const jpeg_decompress_struct& jpeg)
{
    const jpeg_component_info* parts = jpeg.comp_info;
    return jpeg.num_components == 3 && (parts[1].h_samp_factor < parts[0].h_samp_factor ||
                                        parts[1].v_samp_factor < parts[0].v_samp_factor);
}

/// What printers put on white, as files have it: 255 is no ink.
std::vector<uint8_t> rgbFromInks(const std::vector<uint8_t>& cmyk)
{
    std::vector<uint8_t> rgb(cmyk.size() / 4 * 3);
    for (size_t i = 0; i < rgb.size(); ++i) {
        const size_t pixel = i / 3;
        rgb[i] = static_cast<uint8_t>((cmyk[4 * pixel + i % 3] * cmyk[4 * pixel + 3] + 127) / 255);
    }
    return rgb;
}

class JpegReader
{
public:
    explicit JpegReader(std::span<const std::byte> bytes)
    {
        jpeg_.err = failure_.start();
        if (readHeader(bytes)) return;
        jpeg_destroy_decompress(&jpeg_);
        throw UndecodablePicture(failure_.message.data());
    }
    ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;

    Picture read(const HeaderCheck& check);

private:
    bool readHeader(std::span<const std::byte> bytes);
    bool readRows(uint8_t* to);

    Failure failure_;
    jpeg_progress_mgr progress_{};
    jpeg_decompress_struct jpeg_{};
    PictureHeader header_;
};

bool JpegReader::readHeader(std::span<const std::byte> bytes)
{
    if (setjmp(failure_.back) != 0) return false;
    jpeg_create_decompress(&jpeg_);
    progress_.progress_monitor = Failure::onProgress;
    jpeg_.progress = &progress_;
    jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&jpeg_, TRUE);
    const J_COLOR_SPACE space = jpeg_.out_color_space;
    if (space != JCS_GRAYSCALE && space != JCS_CMYK) jpeg_.out_color_space = JCS_RGB; // or it fails
    jpeg_calc_output_dimensions(&jpeg_);
    header_.width = jpeg_.output_width;
    header_.height = jpeg_.output_height;
    header_.channels = jpeg_.out_color_space == JCS_GRAYSCALE ? 1 : 3;
    header_.halvesColor = halvesColor(jpeg_);
    return true;
}

bool JpegReader::readRows(uint8_t* to)
{
    if (setjmp(failure_.back) != 0) return false;
    jpeg_start_decompress(&jpeg_);
    const auto stride =
        static_cast<size_t>(jpeg_.output_width) * static_cast<size_t>(jpeg_.output_components);
    while (jpeg_.output_scanline < jpeg_.output_height) {
        JSAMPROW row = to + jpeg_.output_scanline * stride;
        jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
}

Picture JpegReader::read(const HeaderCheck& check)
{
    check(header_);
    const auto channels = static_cast<size_t>(jpeg_.out_color_components);
    std::vector<uint8_t> samples(static_cast<size_t>(header_.width * header_.height) * channels);
    if (!readRows(samples.data())) throw UndecodablePicture(failure_.message.data());
    if (jpeg_.out_color_space == JCS_CMYK) samples = rgbFromInks(samples);
    return {header_, std::move(samples)};
}

/// libjpeg's own memory, which it lets grow.
struct Encoded
{
    Encoded() = default;
    ~Encoded() { std::free(bytes); }
    Encoded(const Encoded&) = delete;
    Encoded& operator=(const Encoded&) = delete;

    unsigned char* bytes = nullptr;
    unsigned long size = 0;
};

bool writeRows(jpeg_compress_struct& jpeg, Failure& failure, const uint8_t* rgb, Size size,
               Encoded& to)
{
    if (setjmp(failure.back) != 0) return false;
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &to.bytes, &to.size);
    jpeg.image_width = static_cast<JDIMENSION>(size.width);
    jpeg.image_height = static_cast<JDIMENSION>(size.height);
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, kQuality, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < jpeg.image_height) {
        // libjpeg only reads what it calls not const
        auto* row = const_cast<uint8_t*>(rgb + 3 * size_t{jpeg.next_scanline} * jpeg.image_width);
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    return true;
}

} // namespace

Picture readJpeg(std::span<const std::byte> bytes, const HeaderCheck& check)
{
    return JpegReader(bytes).read(check);
}

std::vector<uint8_t> encodeJpeg(std::span<const uint8_t> rgb, Size size)
{
    Failure failure;
    Encoded encoded;
    jpeg_compress_struct jpeg{};
    jpeg.err = failure.start();
    const bool isWritten = writeRows(jpeg, failure, rgb.data(), size, encoded);
    jpeg_destroy_compress(&jpeg);
    if (!isWritten) fail(ErrorCode::cannotWrite, "jpeg", failure.message.data());
    return {encoded.bytes, encoded.bytes + encoded.size};
}

} // namespace relamp
