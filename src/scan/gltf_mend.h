#pragma once

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

namespace relamp
{

/// Puts right what a scan could be read in spite of, so that what is written breaks no rule of
/// glTF: no number is NaN or infinite, normals are of unit length, bounds are stated where they
/// must be and true where they are. Changes the numbers in `model`'s buffer and what `document`,
/// the JSON that it was made of, says of them.
void mendAccessors(tinygltf::Model& model, nlohmann::json& document);

} // namespace relamp
