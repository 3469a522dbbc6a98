#pragma once

namespace relamp
{

/// How a picture shows light that is brighter than paper.
enum class View {
    standard, // as it is, cut off at white: what a scan's texture is
    agx,      // AgX: bright colours fade to white, as on film
    aces      // ACES: contrasty, as in films
};

struct ViewOptions
{
    View view = View::standard;
    float exposure = 0.0f; // stops; light is multiplied by 2^exposure; -32..32
};

} // namespace relamp
