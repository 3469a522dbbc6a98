#include "albedo/confidence.h"

#include "albedo/confidence.shared.h"

namespace relamp
{
namespace
{

constexpr bool areSame(Doubt doubt, uint number)
{
    return static_cast<uint>(doubt) == number;
}
static_assert(areSame(Doubt::none, kDoubtNone) && areSame(Doubt::clipped, kDoubtClipped) &&
              areSame(Doubt::shines, kDoubtShines) && areSame(Doubt::unlit, kDoubtUnlit) &&
              areSame(Doubt::unseen, kDoubtUnseen) && areSame(Doubt::backFace, kDoubtBackFace) &&
              areSame(Doubt::penumbra, kDoubtPenumbra) &&
              areSame(Doubt::whiterThanPaper, kDoubtWhiterThanPaper) &&
              areSame(Doubt::shared, kDoubtShared) && areSame(Doubt::unproven, kDoubtUnproven));

} // namespace

uint8_t Confidence::byte() const
{
    return static_cast<uint8_t>(confidenceByte(value));
}

Confidence confidenceOf(glm::vec3 radiance, float burntOut, glm::vec3 shading, float darkest,
                        SurfelTrust trust, float hidden)
{
    const Rated rated = ratedAlbedo(radiance, burntOut, shading, darkest,
                                    {trust.seen, trust.front, trust.edges, trust.proven}, hidden);
    return {rated.value, static_cast<Doubt>(doubtOf(rated))};
}

} // namespace relamp
