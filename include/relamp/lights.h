#pragma once

#include "relamp/api.h"
#include "relamp/camera_model.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// The largest number that a FixtureMap's file can hold.
constexpr int kLargestFixtureId = (1 << 24) - 3;

/// Something in the room that shines by itself: a lamp, a panel, a window pane.
struct Fixture
{
    glm::vec3 centre{0.0f};   // world, m
    glm::vec3 normal{0.0f};   // unit, mean of its surface; zero where it shines all around
    float area = 0.0f;        // m^2 of its surface
    glm::vec3 radiance{0.0f}; // RGB, 1 = the texture's white
    glm::vec3 error{0.0f};    // standard error of log power; 0 where none is known
    bool determined = true;   // false: the scan does not tell its radiance, which is a guess
    int id = -1;              // its number wherever it is named, 0..kLargestFixtureId; -1: none yet
    std::string name;         // "ceiling lamp 1", unlike others' of the room; or none
    float unseen = 0.0f;      // m^2 of `area`: its far side, which the scan does not show
    int group = -1;           // one number: alike neighbours that were found as one; or none

    /// Flux pi * radiance * area, in radiance * m^2 * sr.
    [[nodiscard]] glm::vec3 power() const { return 3.14159265f * area * radiance; }
};

/// Whose the texels of one page are.
struct FixtureMap
{
    static constexpr int32_t kNone = -1; // not burnt out, and no lamp's
    static constexpr int32_t kWall = -2; // burnt out, and no fixture's

    int width = 0;
    int height = 0;
    std::vector<int32_t> id; // of the fixture, or kNone, or kWall; width * height
};

/// A light without extent.
struct PointLight
{
    glm::vec3 position{0.0f}; // world, m
    glm::vec3 normal{
        0.0f}; // where the surface that it stands for faces; zero for none. Does not aim it
    glm::vec3 intensity{0.0f}; // RGB radiant intensity, radiance * m^2; E = intensity cos / d^2
    float radius = 0.0f;       // m; rms distance of the patch that it stands for from its centre
    int fixture = -1;          // place in Lights::fixtures, not its number; -1 for none
};

/// The sun, where it shines into a room.
struct Sun
{
    glm::vec3 direction{0.0f, 1.0f, 0.0f}; // unit, from the room to the sun
    glm::vec3 irradiance{0.0f};            // RGB, radiance * sr, on a surface that faces it
    glm::vec3 error{0.0f};  // standard error of irradiance as a share of it; 0: none is known
    bool determined = true; // false: irradiance is a lower bound
};

/// How far the shading of a room is believed: as `scale` `kept` (shading / kept)^power
/// (docs/method/cross_validation.md, told_paint.md).
struct Tempering
{
    glm::vec3 kept{1.0f}; // shading that stays as it is, > 0
    float power = 1.0f; // 0..1; 1: all of it is believed; 0: nothing is, and where `kept` is 1 the
                        // texture is the albedo
    glm::vec3 scale{1.0f}; // of all shading, > 0, so that it is as bright as rooms are, or as a
                           // person said; the lights have it

    bool operator==(const Tempering&) const = default;
};

/// All light of a room, as delight finds it and a person may edit it.
///
/// A lamp of a scan has the same number and name in whatever quality it is found.
struct Lights
{
    std::vector<Fixture> fixtures;
    std::vector<PointLight> points;
    // Radiance of what lies outside the scan, seen through its holes; to the thesis solver,
    // irradiance / pi, the same everywhere.
    glm::vec3 ambient{0.0f};
    // How many times that its parts have, small holes together and each large one:
    // docs/method/openings.md. Empty: all the same. Another number than the scan has is passed
    // over, with a warning.
    std::vector<glm::vec3> openings;
    std::optional<Sun> sun; // the thesis solver has none
    CameraModel camera;     // what it made of this light in the texture; the thesis solver knows
                            // none
    Tempering tempering;    // of its shading; the thesis solver knows none
    float gaps = 0.0f;      // how likely the mesh has gaps that let light in, 0..1; likewise

    /// The number of a fixture by its place in the list; those without one are counted behind all
    /// others.
    [[nodiscard]] RELAMP_API int idOf(size_t place) const;
    /// Its name, or "fixture 3" where it has none.
    [[nodiscard]] RELAMP_API std::string nameOf(size_t place) const;
    /// The place of the fixture with a number; fixtures.size() where none has it.
    [[nodiscard]] RELAMP_API size_t placeOf(int id) const;
};

/// lights.json, described in docs/guide/lights.md. `warnings` receives a sentence a key that is not
/// known and was passed over. Throws Error(cannotRead | malformed) naming the line or the key.
RELAMP_API Lights readLights(const std::filesystem::path& file, std::vector<std::string>& warnings);

/// The text of lights.json.
RELAMP_API std::string lightsAsJson(const Lights& lights);

} // namespace relamp
