#pragma once

#include "relamp/api.h"
#include "relamp/camera.h"
#include "relamp/image.h"
#include "relamp/progress.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

enum class UpAxis { y, z };

struct ScanOptions
{
    UpAxis up = UpAxis::y; // the file's axis that points to the ceiling
    double scale = 1.0;    // metres a unit of the file, > 0
    Transfer transfer = Transfer::automatic;
    std::vector<std::string> skipMeshes; // names of meshes to leave out
    bool allowOverlap =
        false;           // work on it even where texels that stand for several places spoil it
    int longestSide = 0; // pixels; longer textures are halved until they fit; 0: none is
    bool allowOutside = false; // also files that lie outside of the scan's folder, which a
                               // stranger's scan could carry off
};

/// What a texture shows outside [0, 1].
enum class Wrap { repeat, mirror, clamp };

/// One piece of surface with one material: a glTF primitive at its node, or a mesh of another
/// format.
///
/// All positions are in the world: metres, right-handed, Y up. Every number is finite, every index
/// in range, every triangle has an area.
struct Mesh
{
    std::string name;
    int page = -1; // index into Scan::pages
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    glm::vec3 factor{1.0f}; // linear; multiplies what the page shows
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;        // of `positions`, v downwards; empty on a page of vertices
    std::vector<glm::vec3> colors;     // of `positions`, linear, multiplies the page; may be empty
    std::vector<glm::uvec3> triangles; // counter-clockwise seen from the lit side
    std::vector<glm::vec3> normals;    // unit, one a triangle's corner: 3 * triangles
    std::vector<glm::vec3> facings;    // unit, one a triangle, with the noise that was taken off
                                       // `normals`; empty where none was
    size_t firstPixel = 0;             // on a page of vertices: pixel of vertex 0
};

/// A texture with baked-in light, or the colours of all vertices of meshes without texture.
struct Page
{
    std::string name;
    Image image;
    bool ofVertices = false; // one pixel a vertex, in the order of the file, and no neighbourhood
};

/// A camera that the file has put into the room.
struct ScanCamera
{
    int index = 0; // as the file counts its cameras
    std::string name;
    Camera camera;
};

struct GltfSource; // the file a glTF scan came from, kept for writing it back

/// A scanned room: surfaces in metres and the pictures of light on them.
struct Scan
{
    std::string name;           // of the file, without folder and ending
    std::filesystem::path file; // that it was read from, as it was named; empty: none
    std::vector<Mesh> meshes;
    std::vector<Page> pages;
    std::vector<ScanCamera> cameras;   // of glTF: those in perspective, by index
    ScanOptions options;               // that it was read with
    std::vector<std::string> warnings; // what was left out or repaired, a sentence each
    glm::mat4 worldFromFile{1.0f};
    std::shared_ptr<const GltfSource> gltf; // null for other formats

    [[nodiscard]] RELAMP_API size_t triangleCount() const;
    /// What messages call it: the file, or the name where there is none.
    [[nodiscard]] RELAMP_API std::string title() const;
};

struct Bounds
{
    glm::vec3 low{0.0f};
    glm::vec3 high{0.0f};

    [[nodiscard]] glm::vec3 extent() const { return high - low; }
    [[nodiscard]] glm::vec3 centre() const { return 0.5f * (low + high); }
    [[nodiscard]] bool contains(glm::vec3 p) const
    {
        return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y &&
               p.z <= high.z;
    }
};

/// The box around all triangles; of a scan without any, a point.
RELAMP_API Bounds boundsOf(const Scan& scan);

/// Reads glTF / GLB, OBJ, PLY, and whatever else Assimp knows.
///
/// Pictures, buffers and materials that it names are read from its folder and those below, links
/// followed; from elsewhere only with `allowOutside`. Throws Error with a sentence on anything that
/// is not a whole, textured or coloured surface, and on what leads outside.
RELAMP_API Scan readScan(const std::filesystem::path& file, const ScanOptions& options = {},
                         Progress& progress = unwatched());

/// A piece of surface in somebody's own memory, as makeScan takes it: a Mesh before it is checked.
struct SurfaceArrays
{
    std::string name;                      // what messages call it
    int texture = -1;                      // index; -1: it has none, but colours
    std::span<const glm::vec3> positions;  // by ScanOptions::up and scale
    std::span<const glm::uvec3> triangles; // counter-clockwise seen from the lit side
    std::span<const glm::vec2> uvs;        // of `positions`, v downwards; of a textured surface
    std::span<const glm::vec3> normals;    // of `positions`, or none: found as readScan finds them
    std::span<const glm::vec3> colors;     // of `positions`, linear, >= 0; or none: white
};

/// A scan of what is in memory, held to the same rules as a file. Nothing that the spans refer to
/// is kept. `name` is what messages, and the GLB of a result, are called by: a file's name without
/// its ending. Of the options, `transfer` counts for nothing: every Image says its own.
///
/// Throws Error(malformed | unsupported) with a sentence: numbers that mean nothing, indices out of
/// range, lists or textures of the wrong length, nothing that shows light.
RELAMP_API Scan makeScan(const std::string& name, std::span<const SurfaceArrays> surfaces,
                         std::vector<Image> textures, const ScanOptions& options = {});

/// The scan with its textures halved, their light averaged, until no side of one is longer than
/// `longestSide` pixels, >= 1.
RELAMP_API Scan coarsened(Scan scan, int longestSide);

} // namespace relamp
