#pragma once

#include "output/listed_folder.h"
#include "relamp/image.h"
#include "relamp/progress.h"
#include "relamp/replacing.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace relamp
{

/// A page's files, all but those of the viewer scripts, so that a browser loads them from a disk,
/// too, where it fetches nothing: `relampPart("geometry", "<base64>");`.
FolderRules rulesOfWebPage(Replacing replacing);

/// Throws Error(cannotRead) where `viewer` lacks a file of those that copyViewer copies.
void checkViewer(const std::filesystem::path& viewer);
void copyViewer(const std::filesystem::path& viewer, const ListedFolder& folder);

/// Writes `name`.js; gives what room.js says of it.
nlohmann::ordered_json writeWebPart(const ListedFolder& folder, const std::string& name,
                                    const std::string& mimeType, std::span<const uint8_t> bytes);

/// A picture of a page, 8-bit RGB.
struct WebPicture
{
    std::vector<uint8_t> rgb;
    int width = 0;
    int height = 0;
};

/// Writes it into a page, and says what room.js does of it.
class WebPictureWriter
{
public:
    WebPictureWriter(const ListedFolder& folder, Progress& progress)
        : folder_(folder), progress_(progress)
    {}

    /// As a PNG, where every byte counts.
    nlohmann::ordered_json exact(const std::string& name, const WebPicture& picture) const;
    /// With loss: as WebP of this quality, 1..100, or as JPEG where that cannot be.
    nlohmann::ordered_json photo(const std::string& name, const WebPicture& picture,
                                 int quality) const;
    /// The same of sRGB; `smaller` of what is given are pictures of it whose longer side has no
    /// more than each of `sides`, where it has more itself.
    nlohmann::ordered_json texture(const std::string& name, WebPicture picture,
                                   std::span<const int> sides) const;

private:
    const ListedFolder& folder_;
    Progress& progress_;
};

/// Writes room.js.
void writeRoomScript(const ListedFolder& folder, const nlohmann::ordered_json& room);

} // namespace relamp
