#pragma once

#include "relamp/api.h"
#include "relamp/delight.h"
#include "relamp/devices.h"
#include "relamp/image.h"
#include "relamp/lights.h"
#include "relamp/progress.h"
#include "relamp/scan.h"
#include "relamp/view.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// How a lamp spreads its light, as an IES file has it: gains over the angle from its direction and
/// over the angle around it.
struct LightProfile
{
    std::vector<float> vertical; // rad from the direction, ascending, 0..pi
    std::vector<float>
        horizontal;          // rad around it from `along`, ascending; one: the same all around
    std::vector<float> gain; // >= 0, horizontal.size() * vertical.size(), row by row

    /// Gain at these angles, rad: linear between the angles that are there, around the full circle;
    /// 0 beyond the last vertical one.
    [[nodiscard]] RELAMP_API float at(float verticalAngle, float horizontalAngle) const;
};

enum class LightType {
    point,
    spot,
    rectangle, // an area that shines from its front
    disc,
    sphere,
    sun // from far away
};

/// A light that somebody puts up. In pictures it is seen if it has a surface; in textures it is
/// not, and nothing is lit by it from behind.
struct NewLight
{
    LightType type = LightType::point;
    // RGB. Point and spot: radiant intensity along the direction, E = intensity cos / d^2.
    // Rectangle, disc, sphere: radiance. Sun: irradiance on a surface that faces it.
    glm::vec3 emission{0.0f};
    glm::vec3 position{0.0f};               // world, m; the centre of an area
    glm::vec3 direction{0.0f, -1.0f, 0.0f}; // unit; where the light goes, or an area faces
    glm::vec3 along{0.0f};                  // of a rectangle's width; zero: anyhow, but level
    glm::vec2 size{0.0f};                   // m; of a rectangle
    float radius = 0.0f;    // m; of a disc, a sphere, and of a bulb in a point or spot
    float cone = 0.785398f; // rad from the axis to a spot's edge, 0..pi
    float blend = 0.15f;    // share of the cone's angle over which it fades out, 0..1
    float angle = 0.00925f; // rad; the sun's diameter
    std::shared_ptr<const LightProfile> profile; // of a point or spot
};

/// What lies outside the scan and is seen through its holes.
struct Sky
{
    glm::vec3 radiance{0.0f};                 // multiplies the picture, if there is one
    std::shared_ptr<const Image> environment; // latitude by longitude, up is up; or none
    float turn = 0.0f;                        // rad, of the picture around the vertical
};

/// A fixture with what it sends now. One of the room is known by its number; one without a number,
/// or with one that is none of the room's, is a disc, or a ball where it has no normal.
struct LitFixture
{
    Fixture fixture;       // radiance 0: switched off
    bool isWindow = false; // an opening: sun goes through, and the sky makes it shine
};

/// All light of a room as somebody wants it.
struct Relighting
{
    std::vector<NewLight> lights;
    std::vector<LitFixture> fixtures; // first those of the room, in its order
    Sky sky;
    bool windowsAreSaid = false; // true: nothing is a window but what `isWindow` says
};

/// The room's own fixtures, all switched off.
RELAMP_API Relighting darkened(const Lights& captured);

/// The light that the scan was made in: fixtures on, sun, and what came through holes, which is one
/// sky here.
RELAMP_API Relighting asCaptured(const Lights& captured);

/// Reads a lights file for relighting, described in docs/guide/lights.md: what delight writes, and
/// lights of all types. Fixtures of the room are off unless the file turns them on. `warnings`
/// receives a sentence a key that was passed over. Throws Error(cannotRead | malformed) naming the
/// line and the key.
RELAMP_API Relighting readRelighting(const std::filesystem::path& file, const Lights& captured,
                                     std::vector<std::string>& warnings);

/// The same of texts, again and again, as a person changes the light: IES profiles and pictures
/// that they name are read once.
class RELAMP_API RelightingReader
{
public:
    RelightingReader();
    ~RelightingReader();
    RelightingReader(RelightingReader&&) noexcept;
    RelightingReader& operator=(RelightingReader&&) noexcept;

    /// `file` is what the text is called in errors, and what it names lies beside that. Throws
    /// Error(malformed), and Error(cannotRead) of what it names.
    [[nodiscard]] Relighting read(const std::string& text, const std::filesystem::path& file,
                                  const Lights& captured, std::vector<std::string>& warnings);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Does what a person says of fixtures: "2=off", "0=on", "all=on", "1=50%", "3=window". Throws
/// Error(malformed) naming the setting.
RELAMP_API void setFixture(Relighting& lighting, const Lights& captured,
                           const std::string& setting);

struct RelightOptions
{
    Solver solver = Solver::gather; // gather: radiosity with shadows; see docs/guide/relighting.md
    int rays = 0;                   // of a surfel, for bounce light, 4..1024; 0: by their number
    int shadowRays = 16;            // of a texel, or 6 mm, in a penumbra, to each light, 1..1024
    PathtraceOptions pathtrace;
    ThesisOptions thesis;
    std::filesystem::path transport; // file that keeps what the rays met; empty: nothing is kept
    EngineOptions engine;            // of the bounces of Solver::gather; all else is the CPU's
};

/// A room without its light.
struct DelitRoom
{
    std::shared_ptr<const Scan> scan; // of a result, as its GLB has it: with albedo for texture
    std::filesystem::path scanFile;   // that it was made from; it need not be there
    std::filesystem::path folder;     // of its result; empty: it has none
    std::vector<Image> albedo;        // a page each, of its size
    std::vector<Image> confidence;    // the same, 0: a guess; empty: all can be trusted
    std::vector<FixtureMap> fixtures; // the same; empty: they are what is burnt out at their places
    std::vector<CorrectionMap> correction; // the same; empty: no light is corrected
    Lights captured;                       // what the scan was lit by
    GatherOptions gather;                  // how its lamps were found
    bool isLit = true;                     // whether the scan's texture shows that light
    std::filesystem::path transport; // where RelightOptions::transport belongs; empty for a GLB
    std::vector<std::string> warnings;
};

struct DelitOptions
{
    std::filesystem::path scan; // of readScanned: where the scan is now; empty: where it was, by
                                // the way from the folder
    std::vector<std::filesystem::path> albedo; // instead of the room's own, one a page
    ScanOptions asScan; // how to read what is no folder; of readScanned, allowOutside alone
    bool textureIsAlbedo = false; // of what relamp did not write: no light was ever baked into it
};

/// Reads what relamp delight wrote: its folder, or its GLB, in that folder, which stands for it, or
/// anywhere else, with the lights that it tells of; or another scan whose texture is an albedo. The
/// scan that a result was made from need not be there.
/// Throws Error with a sentence where something is missing or of another size, or nothing says that
/// the texture is an albedo.
RELAMP_API DelitRoom readDelitRoom(const std::filesystem::path& folderOrScan,
                                   const DelitOptions& options = {},
                                   Progress& progress = unwatched());

/// The room that was taken apart, in memory: it looks as the one that readDelitRoom reads of what
/// writeResult wrote, but for the rounding of its files. Shares the scan. Divides every page;
/// throws Error(cancelled).
RELAMP_API DelitRoom delitRoomOf(const Decomposition& decomposition,
                                 Progress& progress = unwatched());

/// The textures of the scan that a room was made from, as it was lit, one a page; of a room without
/// a folder, its own. Throws Error with a sentence where the scan is not there or another file than
/// it was.
RELAMP_API std::vector<Image> readScanned(const DelitRoom& room, const DelitOptions& options,
                                          Progress& progress);

/// Puts light into a room, again and again: what rays find of the room they find once.
///
/// The same room and light give the same radiance on any number of threads.
class RELAMP_API Relighter
{
public:
    /// Casts the rays, or reads what they met from `options.transport` where that is of this room
    /// and these options; else it is written there, as far as the place lets it. `room` must
    /// outlive this. Throws Error(unsupported | cancelled), and Error(device) where the options ask
    /// for a GPU that is not there.
    explicit Relighter(const DelitRoom& room, const RelightOptions& options = {},
                       Progress& progress = unwatched());
    explicit Relighter(DelitRoom&& room, const RelightOptions& options = {},
                       Progress& progress = unwatched()) = delete;
    ~Relighter();
    Relighter(Relighter&&) noexcept;
    Relighter& operator=(Relighter&&) noexcept;

    /// Another albedo and confidence of the same room, as DelitRoom has them; what rays found is
    /// kept. They must outlive this, or their place is taken again. A light has to be set after it.
    /// Throws Error(sizeMismatch), and leaves all as it was, where they are of another size.
    void repaint(std::span<const Image> albedo, std::span<const Image> confidence);

    /// Sets the light. Shadows are found for lights whose place or shape is new; all else is sums.
    void light(const Relighting& lighting, Progress& progress = unwatched());

    /// The same for a first look while a person moves a lamp: shadows are as fine as a surfel, 3 to
    /// 12 cm, and LightProbes alone can be asked until `light` is called again. Only with
    /// Solver::gather; others do what `light` does.
    void glance(const Relighting& lighting, Progress& progress = unwatched());

    /// Radiance of every texel of a page under the light that was set, linear half RGB of the
    /// page's size; pixels that no surface covers continue what lies next to them.
    [[nodiscard]] Image radiance(size_t page, Progress& progress = unwatched()) const;
    /// Irradiance / pi of the same, a lightmap; `longestSide` as LightmapOptions has it.
    [[nodiscard]] Image shading(size_t page, int longestSide = 0,
                                Progress& progress = unwatched()) const;

    [[nodiscard]] const DelitRoom& room() const;
    /// What is doubtful of the room or of the light that was set, a sentence each.
    [[nodiscard]] const std::vector<std::string>& warnings() const;

    struct State; // for relamp's own parts; its type is not public
    [[nodiscard]] const State& state() const;

private:
    std::unique_ptr<State> state_;
};

/// Radiance of all pages under some light, once.
RELAMP_API std::vector<Image> relight(const DelitRoom& room, const Relighting& lighting,
                                      const RelightOptions& options = {},
                                      Progress& progress = unwatched());

/// Writes the light that was set as textures: `file` ends in .exr, one picture of linear radiance a
/// page (name.0.exr, name.1.exr where there are several); or in .glb, the scan unlit with the light
/// in its textures, as `view` shows it. All files or none. Throws Error(cannotWrite | cancelled).
RELAMP_API void writeBaked(const Relighter& relighter, const std::filesystem::path& file,
                           const ViewOptions& view = {}, Progress& progress = unwatched());

} // namespace relamp
