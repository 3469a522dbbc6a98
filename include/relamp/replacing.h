#pragma once

namespace relamp
{

/// Which files of a folder may be replaced or removed by what is written into it anew.
enum class Replacing {
    unchanged, // those that relamp wrote there and nobody changed since; with others there, nothing
               // is written
    any
};

} // namespace relamp
