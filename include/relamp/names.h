#pragma once

#include "relamp/camera.h"
#include "relamp/delight.h"
#include "relamp/devices.h"
#include "relamp/gather.h"
#include "relamp/image.h"
#include "relamp/lightmaps.h"
#include "relamp/relight.h"
#include "relamp/scan.h"
#include "relamp/view.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace relamp
{

/// What the values of an enumeration are called on the command line, in lights, camera and report
/// files, and in the viewer's scripts; in the order of the values, which are 0, 1, 2 and so on.
template<class Enum>
struct Names;

template<>
struct Names<Solver>
{
    static constexpr std::array<const char*, 3> all{"gather", "pathtrace", "thesis"};
};

template<>
struct Names<Quality>
{
    static constexpr std::array<const char*, 3> all{"draft", "standard", "high"};
};

template<>
struct Names<Doubt>
{
    static constexpr std::array<const char*, kDoubts> all{
        "none",     "clipped",  "shines",          "unlit",  "unseen",
        "backFace", "penumbra", "whiterThanPaper", "shared", "unproven"};
};

template<>
struct Names<Transfer>
{
    static constexpr std::array<const char*, 3> all{"auto", "srgb", "linear"};
};

template<>
struct Names<UpAxis>
{
    static constexpr std::array<const char*, 2> all{"y", "z"};
};

template<>
struct Names<Engine>
{
    static constexpr std::array<const char*, 3> all{"auto", "cpu", "gpu"};
};

template<>
struct Names<LightType>
{
    static constexpr std::array<const char*, 6> all{"point", "spot",   "rectangle",
                                                    "disc",  "sphere", "sun"};
};

template<>
struct Names<LightmapFormat>
{
    static constexpr std::array<const char*, 2> all{"exr", "png"};
};

template<>
struct Names<View>
{
    static constexpr std::array<const char*, 3> all{"standard", "agx", "aces"};
};

template<>
struct Names<Across>
{
    static constexpr std::array<const char*, 2> all{"width", "height"};
};

template<class Enum>
[[nodiscard]] constexpr const char* nameOf(Enum value)
{
    return Names<Enum>::all[static_cast<size_t>(value)];
}

/// The value of a name; none where it is nobody's.
template<class Enum>
[[nodiscard]] constexpr std::optional<Enum> named(std::string_view name)
{
    for (size_t i = 0; i < Names<Enum>::all.size(); ++i)
        if (name == Names<Enum>::all[i]) return static_cast<Enum>(i);
    return std::nullopt;
}

/// All names, "gather, pathtrace, thesis", for a sentence.
template<class Enum>
[[nodiscard]] std::string namesInWords()
{
    std::string words;
    for (const char* name : Names<Enum>::all)
        words += (words.empty() ? "" : ", ") + std::string(name);
    return words;
}

} // namespace relamp
