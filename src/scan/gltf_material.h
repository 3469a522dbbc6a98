#pragma once

#include "relamp/scan.h"

#include <optional>

#include <glm/mat3x3.hpp>
#include <tiny_gltf.h>

namespace relamp
{

/// What a glTF material says about the colour of a surface.
struct BaseColor
{
    int image = -1;   // index into the model's images; -1 where it has no texture
    int texCoord = 0; // set of texture coordinates
    glm::mat3 uvFromTexCoord{1.0f};
    glm::vec3 factor{1.0f}; // linear
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
};

/// The base colour of `material` (-1: glTF's default material).
///
/// Knows metallic-roughness, KHR_materials_pbrSpecularGlossiness, KHR_texture_transform and
/// EXT_texture_webp. `what` begins the sentence of the Error(malformed) on dangling references.
BaseColor baseColorOf(const tinygltf::Model& model, int material, const std::string& what);

/// Index of the image that a texture shows, preferring WebP where the texture has both; -1 where
/// there is none.
int findImage(const tinygltf::Model& model, int texture);

/// The same; Error, beginning with `what` and saying why, where there is none.
int imageOfTexture(const tinygltf::Model& model, int texture, const std::string& what);

} // namespace relamp
