#include "lamp_shapes.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace
{

constexpr int kAround = 24; // corners of a round thing
constexpr float kPi = glm::pi<float>();

/// Two directions across another.
struct Across
{
    glm::vec3 u, v;

    Across(glm::vec3 direction, glm::vec3 along)
    {
        const glm::vec3 level(-direction.z, 0.0f, direction.x);
        glm::vec3 wanted = glm::dot(along, along) > 0.0f    ? along
                           : glm::dot(level, level) > 1e-8f ? level
                                                            : glm::vec3(1, 0, 0);
        wanted -= glm::dot(wanted, direction) * direction;
        u = glm::dot(wanted, wanted) > 1e-8f ? glm::normalize(wanted) : glm::vec3(1, 0, 0);
        v = glm::cross(direction, u);
    }
};

void addRectangle(const relamp::NewLight& light, std::vector<LampVertex>& out)
{
    const Across across(light.direction, light.along);
    const glm::vec3 u = 0.5f * light.size.x * across.u;
    const glm::vec3 v = 0.5f * light.size.y * across.v;
    const glm::vec3 corners[] = {light.position - u - v, light.position + u - v,
                                 light.position + u + v, light.position - u + v};
    for (const int corner : {0, 1, 2, 0, 2, 3}) out.push_back({corners[corner], light.emission});
}

void addDisc(const relamp::NewLight& light, std::vector<LampVertex>& out)
{
    const Across across(light.direction, light.along);
    const auto rim = [&](int i) {
        const float angle = 2.0f * kPi * static_cast<float>(i) / kAround;
        return light.position +
               light.radius * (std::cos(angle) * across.u + std::sin(angle) * across.v);
    };
    for (int i = 0; i < kAround; ++i)
        for (const glm::vec3& corner : {light.position, rim(i), rim(i + 1)})
            out.push_back({corner, light.emission});
}

void addSphere(const relamp::NewLight& light, glm::vec3 radiance, std::vector<LampVertex>& out)
{
    constexpr int kRings = kAround / 2;
    const auto at = [&](int ring, int i) {
        const float down = kPi * static_cast<float>(ring) / kRings;
        const float around = 2.0f * kPi * static_cast<float>(i) / kAround;
        return light.position + light.radius * glm::vec3(std::sin(down) * std::cos(around),
                                                         std::cos(down),
                                                         std::sin(down) * std::sin(around));
    };
    for (int ring = 0; ring < kRings; ++ring)
        for (int i = 0; i < kAround; ++i)
            for (const glm::vec3& corner : {at(ring, i), at(ring + 1, i), at(ring + 1, i + 1),
                                            at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)})
                out.push_back({corner, radiance});
}

} // namespace

std::vector<LampVertex> lampShapes(std::span<const relamp::NewLight> lights)
{
    using relamp::LightType;
    std::vector<LampVertex> out;
    for (const relamp::NewLight& light : lights) {
        if (light.emission == glm::vec3(0.0f)) continue;
        if (light.type == LightType::rectangle) addRectangle(light, out);
        if (light.type == LightType::disc) addDisc(light, out);
        if (light.type == LightType::sphere) addSphere(light, light.emission, out);
        // Intensity is the radiance of a ball times its disc.
        const bool isBulb = light.type == LightType::point || light.type == LightType::spot;
        if (isBulb && light.radius > 0.0f)
            addSphere(light, light.emission / (kPi * light.radius * light.radius), out);
    }
    return out;
}
