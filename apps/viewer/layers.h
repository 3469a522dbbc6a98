#pragma once

#include <array>
#include <cstddef>

/// What the viewer shows on the room's surface, in the order of the number keys;
/// shaders/layers.glsl counts them alike.
enum class Layer { scan, flattened, direct, indirect, shading, albedo, confidence, relit };

struct LayerName
{
    Layer layer;
    const char* name;  // in scripts and settings
    const char* title; // on the screen
};

constexpr std::array<LayerName, 8> kLayers{{{Layer::scan, "texture", "Texture, as scanned"},
                                            {Layer::flattened, "flattened", "Flattened"},
                                            {Layer::direct, "direct", "Direct light"},
                                            {Layer::indirect, "indirect", "Indirect light"},
                                            {Layer::shading, "shading", "Shading"},
                                            {Layer::albedo, "albedo", "Albedo"},
                                            {Layer::confidence, "confidence", "Confidence"},
                                            {Layer::relit, "relit", "Relit"}}};

/// A layer's picture on a page; relit and scan are layers themselves, shading is a sum.
enum class PageTexture { scan, flattened, direct, indirect, albedo, confidence, relit };
constexpr size_t kPageTextures = 7;
