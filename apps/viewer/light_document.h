#pragma once

#include "relamp/lights.h"
#include "relamp/relight.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

/// A light that somebody puts up, in the words of a lights file (docs/guide/lights.md).
struct LampItem
{
    std::string name;
    relamp::LightType type = relamp::LightType::point;
    glm::vec3 position{0.0f};               // m
    glm::vec3 direction{0.0f, -1.0f, 0.0f}; // unit
    glm::vec3 along{0.0f};                  // of a rectangle's width; zero: anyhow
    glm::vec2 size{0.6f, 0.6f};             // m; of a rectangle
    float radius = 0.05f;                   // m; bulb, disc, sphere
    float cone = 60.0f;                     // degrees, edge to edge
    float blend = 0.15f;
    float angle = 0.53f;         // degrees; the sun's
    std::string unit = "lumens"; // a key of the file that takes one number, or three
    float amount = 800.0f;       // in that unit
    glm::vec3 rgb{0.0f};         // instead, where the unit is intensity, radiance or irradiance
    bool byKelvin = true;        // else by colour
    float kelvin = 2700.0f;
    glm::vec3 colour{1.0f};
    bool on = true;
    float dim = 1.0f;
    std::string ies; // file beside the lights file

    bool operator==(const LampItem&) const = default;
    [[nodiscard]] bool takesRgb() const;
    /// Whether its direction matters.
    [[nodiscard]] bool aims() const;
};

/// A fixture of the room, and what is said of it beyond what delight found.
struct FixtureItem
{
    bool on = false;
    float dim = 1.0f;
    std::optional<float> kelvin;
    std::optional<float> lumens;
    std::optional<glm::vec3> radiance;
    bool window = false;

    bool operator==(const FixtureItem&) const = default;
};

/// How a fixture was on the day of the scan, where nobody says otherwise.
inline const FixtureItem kAsFound{.on = true};

/// How a room's light was on the day of the scan, where somebody says otherwise than delight.
struct ScannedItems
{
    std::vector<FixtureItem> fixtures; // of the room, in its order
    float sun = 1.0f;                  // times the sun that was found
    glm::vec3 sunColour{1.0f};         // likewise
    std::optional<glm::vec3> ambient;  // radiance of what lies outside the scan

    bool operator==(const ScannedItems&) const = default;
    [[nodiscard]] bool isAsFound() const;
};

struct SkyItem
{
    float nits = 0.0f;
    glm::vec3 colour{1.0f};
    std::optional<glm::vec3> radiance; // instead
    std::string environment;           // picture beside the file
    float turn = 0.0f;                 // degrees

    bool operator==(const SkyItem&) const = default;
};

/// All light as a person sees and changes it.
struct LightDocument
{
    std::vector<LampItem> lamps;
    std::vector<FixtureItem> fixtures; // of the room, in its order
    SkyItem sky;
    std::optional<float> whiteNits; // what the texture's white stands for
    std::optional<float> whiteKelvin;

    bool operator==(const LightDocument&) const = default;
};

/// Of fixtures that were there before, what was said of them; else `otherwise`. `numbers` are those
/// of `items`.
std::vector<FixtureItem> carriedOver(const std::vector<FixtureItem>& items,
                                     const std::vector<int>& numbers,
                                     const relamp::Lights& captured, const FixtureItem& otherwise);

/// The numbers of a room's fixtures, in their order.
std::vector<int> numbersOf(const relamp::Lights& captured);

/// What was found, had sun and what lies outside been as `scanned` says.
relamp::Lights skyUnder(const ScannedItems& scanned, const relamp::Lights& found);

/// And the fixtures. Of `light` only white counts. Throws relamp::Error as lightingOf().
relamp::Lights lightsUnder(const ScannedItems& scanned, const LightDocument& light,
                           const relamp::Lights& found);

/// Sun and sky of a document that are the room's own, as in `before`, become those of `after`.
void followSky(LightDocument& light, const relamp::Lights& before, const relamp::Lights& after);

/// The fixtures of a room as delight found them, switched on.
LightDocument documentOf(const relamp::Lights& captured);

/// The text of a lights file for the room that was `captured`.
std::string textOf(const LightDocument& document, const relamp::Lights& captured);

/// What a lights file says. `captured` is the room's light. Throws relamp::Error as
/// relamp::readRelighting does; `notes` receives what is passed over.
LightDocument documentFrom(const std::string& text, const std::filesystem::path& file,
                           const relamp::Lights& captured, std::vector<std::string>& notes);

/// The light itself. Files that it names lie in `folder`.
relamp::Relighting lightingOf(const LightDocument& document, const std::filesystem::path& folder,
                              const relamp::Lights& captured, std::vector<std::string>& notes,
                              relamp::RelightingReader& reader);

/// Throws relamp::Error with the names that there are.
relamp::LightType lightTypeNamed(const std::string& name);
