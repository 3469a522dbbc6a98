#pragma once

#include "output/listed_folder.h"
#include "relamp/image.h"
#include "relamp/replacing.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

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

/// The same of a picture, 8-bit RGB: as a JPEG, or as a PNG where every byte counts.
enum class WebPicture { jpeg, png };
nlohmann::ordered_json writeWebPicture(const ListedFolder& folder, const std::string& name,
                                       std::span<const uint8_t> rgb, int width, int height,
                                       WebPicture as);

/// Writes room.js.
void writeRoomScript(const ListedFolder& folder, const nlohmann::ordered_json& room);

} // namespace relamp
