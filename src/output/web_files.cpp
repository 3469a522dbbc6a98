#include "output/web_files.h"

#include "base/fail.h"
#include "base/file.h"
#include "base/parallel.h"
#include "image/transfer.h"
#include "image/write_image.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <vector>

#include <fmt/format.h>

namespace relamp
{
namespace
{

constexpr int kQuality = 90; // of textures, as WebP

constexpr std::array<const char*, 5> kOfViewer{"index.html", "viewer.css", "viewer.js",
                                               "relamp-room.js", "licences.txt"};

bool isOfWebPage(const std::string& name)
{
    if (name == "room.json" || name == "room.js" || name == "preview.jpg") return true;
    if (std::find(kOfViewer.begin(), kOfViewer.end(), name) != kOfViewer.end()) return true;
    constexpr std::array<const char*, 7> kParts{"probes",  "geometry", "albedo", "scan",
                                                "shining", "light",    "bounces"};
    return name.ends_with(".js") && std::any_of(kParts.begin(), kParts.end(), [&](const char* of) {
               const std::string part(of);
               return name.starts_with(part) &&
                      name.find_first_not_of("_0123456789", part.size()) == name.size() - 3;
           });
}

std::string base64(std::span<const uint8_t> bytes)
{
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t left = std::min<size_t>(3, bytes.size() - i);
        uint32_t bits = uint32_t{bytes[i]} << 16;
        if (left > 1) bits |= uint32_t{bytes[i + 1]} << 8;
        if (left > 2) bits |= bytes[i + 2];
        for (size_t digit = 0; digit < 4; ++digit)
            text += digit <= left ? kDigits[(bits >> (18 - 6 * digit)) & 63] : '=';
    }
    return text;
}

nlohmann::ordered_json withSize(nlohmann::ordered_json item, const WebPicture& picture)
{
    item["width"] = picture.width;
    item["height"] = picture.height;
    return item;
}

/// sRGB; light is averaged, not bytes.
WebPicture halved(const WebPicture& picture)
{
    WebPicture half{{}, (picture.width + 1) / 2, (picture.height + 1) / 2};
    half.rgb.resize(3 * static_cast<size_t>(half.width) * static_cast<size_t>(half.height));
    std::array<float, 256> linear{};
    for (size_t i = 0; i < linear.size(); ++i)
        linear[i] = linearFromSrgb(static_cast<float>(i) / 255.0f);
    const auto width = static_cast<size_t>(picture.width);
    const auto height = static_cast<size_t>(picture.height);
    const auto halfWidth = static_cast<size_t>(half.width);
    forEachChunk(static_cast<size_t>(half.height), 16, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (size_t i = 0; i < 3 * halfWidth; ++i) {
                float sum = 0.0f;
                for (const size_t row : {2 * y, 2 * y + 1})
                    for (const size_t column : {2 * (i / 3), 2 * (i / 3) + 1}) {
                        const size_t pixel =
                            std::min(row, height - 1) * width + std::min(column, width - 1);
                        sum += linear[picture.rgb[3 * pixel + i % 3]];
                    }
                half.rgb[3 * y * halfWidth + i] = srgbByteFromLinear(sum / 4.0f);
            }
    });
    return half;
}

} // namespace

FolderRules rulesOfWebPage(Replacing replacing)
{
    return {"room.json", &isOfWebPage, replacing};
}

void checkViewer(const std::filesystem::path& viewer)
{
    std::error_code ignored;
    for (const char* name : kOfViewer)
        if (!std::filesystem::exists(viewer / name, ignored))
            fail(ErrorCode::cannotRead, (viewer / name).string(),
                 "is not there, and a page needs it; it is made where Node.js and npm are: install "
                 "them and build relamp again");
}

void copyViewer(const std::filesystem::path& viewer, const ListedFolder& folder)
{
    for (const char* name : kOfViewer) writeFile(folder / name, readFile(viewer / name));
}

nlohmann::ordered_json writeWebPart(const ListedFolder& folder, const std::string& name,
                                    const std::string& mimeType, std::span<const uint8_t> bytes)
{
    writeFile(folder / (name + ".js"),
              fmt::format("relampPart(\"{}\", \"{}\");\n", name, base64(bytes)));
    return {{"file", name}, {"type", mimeType}, {"bytes", bytes.size()}};
}

nlohmann::ordered_json WebPictureWriter::exact(const std::string& name,
                                               const WebPicture& picture) const
{
    const std::vector<uint8_t> png = encodePng(picture.rgb, {picture.width, picture.height}, 3);
    return withSize(writeWebPart(folder_, name, "image/png", png), picture);
}

nlohmann::ordered_json WebPictureWriter::photo(const std::string& name, const WebPicture& picture,
                                               int quality) const
{
    const Size size{picture.width, picture.height};
    const std::vector<uint8_t> webp = encodeWebp(picture.rgb, size, quality, progress_);
    return withSize(webp.empty()
                        ? writeWebPart(folder_, name, "image/jpeg", encodeJpeg(picture.rgb, size))
                        : writeWebPart(folder_, name, "image/webp", webp),
                    picture);
}

nlohmann::ordered_json WebPictureWriter::texture(const std::string& name, WebPicture picture,
                                                 std::span<const int> sides) const
{
    nlohmann::ordered_json item = photo(name, picture, kQuality);
    for (const int side : sides) {
        if (std::max(picture.width, picture.height) <= side) continue;
        while (std::max(picture.width, picture.height) > side) picture = halved(picture);
        item["smaller"].push_back(
            photo(fmt::format("{}_{}", name, picture.width), picture, kQuality));
    }
    return item;
}

void writeRoomScript(const ListedFolder& folder, const nlohmann::ordered_json& room)
{
    writeFile(folder / "room.js",
              "relampRoom(" + room.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) +
                  ");\n");
}

} // namespace relamp
