#include "output/web_files.h"

#include "base/fail.h"
#include "base/file.h"
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

nlohmann::ordered_json writeWebPicture(const ListedFolder& folder, const std::string& name,
                                       std::span<const uint8_t> rgb, int width, int height,
                                       WebPicture as)
{
    const Size size{width, height};
    const bool isJpeg = as == WebPicture::jpeg;
    const std::vector<uint8_t> bytes = isJpeg ? encodeJpeg(rgb, size) : encodePng(rgb, size, 3);
    nlohmann::ordered_json item =
        writeWebPart(folder, name, isJpeg ? "image/jpeg" : "image/png", bytes);
    item["width"] = width;
    item["height"] = height;
    return item;
}

void writeRoomScript(const ListedFolder& folder, const nlohmann::ordered_json& room)
{
    writeFile(folder / "room.js",
              "relampRoom(" + room.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) +
                  ");\n");
}

} // namespace relamp
