#include "scan/scan_frame.h"

#include <fmt/format.h>

namespace relamp
{

glm::mat4 worldFromFile(const ScanOptions& options)
{
    const auto s = static_cast<float>(options.scale);
    if (options.up == UpAxis::z) // (x, y, z) -> (x, z, -y)
        return {{s, 0, 0, 0}, {0, 0, -s, 0}, {0, s, 0, 0}, {0, 0, 0, 1}};
    return {{s, 0, 0, 0}, {0, s, 0, 0}, {0, 0, s, 0}, {0, 0, 0, 1}};
}

SkippedMeshes::SkippedMeshes(const ScanOptions& options)
{
    for (const std::string& name : options.skipMeshes) isMet_[name] = false;
}

bool SkippedMeshes::holds(const std::string& meshName)
{
    const auto found = isMet_.find(meshName);
    if (found == isMet_.end()) return false;
    found->second = true;
    return true;
}

void SkippedMeshes::tell(std::vector<std::string>& warnings) const
{
    for (const auto& [name, isMet] : isMet_)
        if (!isMet) warnings.push_back(fmt::format("no mesh is called \"{}\" (--skip-mesh)", name));
}

} // namespace relamp
