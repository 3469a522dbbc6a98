#pragma once

#include "relamp/scan.h"

#include <map>
#include <string>
#include <vector>

namespace relamp
{

/// Takes the file's axes and units to metres, Y up.
glm::mat4 worldFromFile(const ScanOptions& options);

/// The meshes that a person asked to leave out.
class SkippedMeshes
{
public:
    explicit SkippedMeshes(const ScanOptions& options);

    /// Whether a mesh of this name, which the file has, is one.
    bool holds(const std::string& meshName);
    /// Adds a note on each name that no mesh had so far.
    void tell(std::vector<std::string>& warnings) const;

private:
    std::map<std::string, bool> isMet_; // by name
};

} // namespace relamp
