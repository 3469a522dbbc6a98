#pragma once

#include "relight/transport.h"
#include "scan/texels.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace relamp
{

/// Says of which scan and options a transport is: its geometry and texture, its surfels, the number
/// of rays.
uint64_t keyOfTransport(const Texels& texels, size_t rays);

/// What saveTransport wrote; nothing where the file is not there, of another version or key, cut
/// off or broken in any way: it can always be made again.
std::optional<Transport> loadTransport(const std::filesystem::path& file, uint64_t key,
                                       const Texels& texels);

/// Writes the file, whole or not at all. Throws Error(cannotWrite).
void saveTransport(const std::filesystem::path& file, uint64_t key, const Transport& transport);

} // namespace relamp
