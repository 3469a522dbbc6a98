#pragma once

#include "lights/json_item.h"
#include "relamp/relight.h"
#include "relight/ies.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace relamp
{

/// Files that lights files name, each read once: lights of one file share what it holds.
struct NamedFiles
{
    std::map<std::filesystem::path, IesPhotometry> ies;
    std::map<std::filesystem::path, std::shared_ptr<const Image>> environments;
};

/// The light that an object of a file says, as readRelighting reads it of a whole file. Files that
/// it names lie in `folder`.
Relighting relightingFrom(const JsonItem& top, const std::filesystem::path& folder,
                          const Lights& captured, NamedFiles& files,
                          std::vector<std::string>& warnings);

} // namespace relamp
