#include "scan/scan_frame.h"

#include <algorithm>

namespace relamp
{

glm::mat4 worldFromFile(const ScanOptions& options)
{
    const auto s = static_cast<float>(options.scale);
    if (options.up == UpAxis::z) // (x, y, z) -> (x, z, -y)
        return {{s, 0, 0, 0}, {0, 0, -s, 0}, {0, s, 0, 0}, {0, 0, 0, 1}};
    return {{s, 0, 0, 0}, {0, s, 0, 0}, {0, 0, s, 0}, {0, 0, 0, 1}};
}

bool isSkipped(const ScanOptions& options, const std::string& meshName)
{
    const auto& skip = options.skipMeshes;
    return std::find(skip.begin(), skip.end(), meshName) != skip.end();
}

} // namespace relamp
