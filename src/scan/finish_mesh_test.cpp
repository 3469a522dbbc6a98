#include "scan/finish_mesh.h"

#include "base/radiometry.shared.h"
#include "scenes/refusal.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Two triangles that share an edge along z; the second is turned up by `degrees` about it.
Mesh hinge(float degrees)
{
    const float angle = degrees * kPi / 180.0f;
    Mesh mesh;
    mesh.name = "hinge";
    mesh.positions = {{0, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {std::cos(angle), std::sin(angle), 0}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}};
    return mesh;
}

std::vector<std::string> finish(Mesh& mesh, std::vector<glm::vec3> normals = {})
{
    std::vector<std::string> warnings;
    finishMesh(mesh, std::move(normals), "room.obj", warnings);
    return warnings;
}

std::string refusal(Mesh mesh)
{
    return scenes::refusalOf([&] { finish(mesh); });
}

} // namespace

TEST(FinishMesh, SmoothsOverABlunterEdgeAndCreasesAtASharperOneThan45Degrees)
{
    Mesh blunt = hinge(40.0f);
    finish(blunt);
    EXPECT_NEAR(glm::length(blunt.normals[0] - blunt.normals[3]), 0.0f,
                1e-6f); // at the shared vertex 0
    Mesh sharp = hinge(50.0f);
    finish(sharp);
    EXPECT_EQ(sharp.normals[0], glm::vec3(0, 1, 0));
}

// Reconstructions come with normals of the same noise as their faces.
TEST(FinishMesh, NormalsOfANoisyFileGiveWayToItsFaces)
{
    constexpr uint32_t kAcross = 17; // vertices
    Mesh wall;
    wall.name = "wall";
    std::vector<glm::vec3> normals;
    for (uint32_t i = 0; i < kAcross * kAcross; ++i) {
        const float error = i * 7919 % 13 < 6 ? 0.004f : -0.004f;
        wall.positions.emplace_back(0.05f * static_cast<float>(i % kAcross), error,
                                    0.05f * static_cast<float>(i / kAcross));
        normals.push_back(glm::normalize(glm::vec3(100.0f * error, 1.0f, 0.0f)));
    }
    for (uint32_t i = 0; i + kAcross < kAcross * kAcross; ++i) {
        if (i % kAcross + 1 == kAcross) continue;
        wall.triangles.emplace_back(i, i + kAcross, i + 1);
        wall.triangles.emplace_back(i + 1, i + kAcross, i + kAcross + 1);
    }
    finish(wall, normals);
    float sum = 0.0f;
    for (const glm::vec3 normal : wall.normals) sum += glm::distance(normal, glm::vec3(0, 1, 0));
    EXPECT_LT(sum / static_cast<float>(wall.normals.size()), 0.1f); // the file's: 0.38

    ASSERT_THAT(wall.facings, SizeIs(wall.triangles.size()));
    const glm::uvec3 t = wall.triangles[5];
    const glm::vec3 mean = glm::normalize(normals[t.x] + normals[t.y] + normals[t.z]);
    EXPECT_NEAR(glm::distance(wall.facings[5], mean), 0.0f, 1e-6f);
}

TEST(FinishMesh, WhereNothingWasTakenOffThereIsNothingToKeep)
{
    Mesh blunt = hinge(40.0f);
    finish(blunt);
    EXPECT_THAT(blunt.facings, IsEmpty());
}

// The far corners belong to one face each, however smooth the edge is.
TEST(FinishMesh, ANormalIsOfTheFacesAroundItsVertexAlone)
{
    Mesh mesh = hinge(40.0f);
    finish(mesh);
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, 1, 0));
}

TEST(FinishMesh, AUvSeamLeavesNoCrease)
{
    Mesh whole = hinge(30.0f);
    finish(whole);
    Mesh torn = hinge(30.0f);
    torn.positions.push_back(torn.positions[0]);
    torn.positions.push_back(torn.positions[1]);
    torn.triangles[1] = {4, 5, 3};
    finish(torn);
    EXPECT_EQ(torn.normals, whole.normals);
}

TEST(FinishMesh, GivenNormalsAreTakenUnlessTheyAreNoneOrPointIntoTheSurface)
{
    Mesh mesh = hinge(0.0f);
    const glm::vec3 slanted = glm::normalize(glm::vec3(1, 2, 0));
    finish(mesh, {slanted * 3.0f, {0, 0, 0}, {0, -1, 0}, {1, 0, 0}});
    EXPECT_NEAR(glm::length(mesh.normals[0] - slanted), 0.0f, 1e-6f);
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, 1, 0)); // of vertex 2: against the face
    EXPECT_EQ(mesh.normals[2], glm::vec3(0, 1, 0)); // of vertex 1: nothing
    EXPECT_EQ(mesh.normals[5], glm::vec3(0, 1, 0)); // of vertex 3: along it
}

TEST(FinishMesh, NormalsThatAreNotOneAVertexAreNotTaken)
{
    Mesh mesh = hinge(0.0f);
    finish(mesh, {{1, 0, 0}});
    EXPECT_THAT(mesh.normals, Each(glm::vec3(0, 1, 0)));
}

TEST(FinishMesh, PositionsThatAreNoPlaceAreCountedAndRefused)
{
    for (const float bad : {kNotANumber, kInfinity, -3e38f, 1.1e5f}) {
        Mesh mesh = hinge(0.0f);
        mesh.positions[3].x = bad;
        EXPECT_THAT(refusal(mesh), StartsWith("room.obj: mesh \"hinge\": 1 of its 4 vertices lie "
                                              "at no place"))
            << bad;
        mesh.positions[0].z = bad;
        EXPECT_THAT(refusal(mesh), HasSubstr("2 of its 4 vertices lie at no place")) << bad;
        EXPECT_THAT(refusal(mesh), HasSubstr("beyond 100 km")) << bad;
        EXPECT_THAT(refusal(mesh), HasSubstr("--skip-mesh \"hinge\"")) << bad;
    }
    Mesh far = hinge(0.0f);
    for (glm::vec3& p : far.positions) p.x += 9.9e4f;
    EXPECT_EQ(refusal(far), "");
}

TEST(FinishMesh, TextureCoordinatesThatTellNoPixelAreCountedAndRefused)
{
    for (const float bad : {kNotANumber, -kInfinity, 1e37f, 1e19f, 1e15f, -1001.0f}) {
        Mesh mesh = hinge(0.0f);
        mesh.uvs = {{0, 0}, {0, 1}, {1, 0}, {bad, 0}};
        EXPECT_THAT(refusal(mesh), HasSubstr("1 of its 4 vertices have texture coordinates"))
            << bad;
    }
    Mesh tiled = hinge(0.0f);
    tiled.uvs = {{0, 0}, {0, 1}, {1, 0}, {-999, 0}};
    EXPECT_EQ(refusal(tiled), "");
}

TEST(FinishMesh, NormalsWithoutLengthOrEndAreCountedAndRefused)
{
    for (const float bad : {kNotANumber, kInfinity, 1e19f}) {
        Mesh mesh = hinge(0.0f);
        const std::vector<glm::vec3> normals{{0, 1, 0}, {0, 1, 0}, {bad, 1, 0}, {0, bad, 0}};
        EXPECT_THAT(scenes::refusalOf([&] { finish(mesh, normals); }),
                    HasSubstr("2 of its 4 vertices have normals"))
            << bad;
    }
}

TEST(FinishMesh, ColoursThatAreNoLightAreCountedAndRefused)
{
    for (const float bad : {kNotANumber, kInfinity, -1.0f, 7e4f}) {
        Mesh mesh = hinge(0.0f);
        mesh.colors = {{0, 1, 0}, {0, 1, 0}, {bad, 1, 0}, {0, 1, 0}};
        EXPECT_THAT(refusal(mesh), HasSubstr("1 of its 4 vertices have colours that are no light"))
            << bad;
        mesh = hinge(0.0f);
        mesh.factor.g = bad;
        EXPECT_THAT(refusal(mesh), HasSubstr("the colour of its material is not from 0")) << bad;
    }
    Mesh rounded = hinge(0.0f);
    rounded.colors.assign(4, glm::vec3(-1e-6f, 0.0f, 2.0f)); // a filter was at work
    finish(rounded);
    EXPECT_THAT(rounded.colors, Each(glm::vec3(0.0f, 0.0f, 2.0f)));
}

TEST(FinishMesh, VerticesThatNoTriangleUsesMayBeAnythingAndComeOutAsNumbers)
{
    Mesh mesh = hinge(0.0f);
    mesh.positions.emplace_back(kNotANumber, 1.0f, 1.0f);
    mesh.uvs = {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {kNotANumber, 0}};
    mesh.colors.assign(5, glm::vec3(1.0f));
    mesh.colors[4].g = kInfinity;
    finish(mesh);
    EXPECT_EQ(mesh.positions[4], glm::vec3(0.0f));
    EXPECT_EQ(mesh.uvs[4], glm::vec2(0.0f));
    EXPECT_EQ(mesh.colors[4], glm::vec3(0.0f));
    EXPECT_THAT(mesh.triangles, SizeIs(2));
}

TEST(FinishMesh, VerticesThatNobodyUsesGoFromTexturedMeshesAlone)
{
    Mesh textured = hinge(0.0f);
    textured.page = 0;
    textured.positions.insert(textured.positions.begin(), 100, glm::vec3(9.0f));
    textured.uvs.assign(104, glm::vec2(0.5f));
    textured.triangles = {{100, 102, 101}, {100, 101, 103}};
    finish(textured);
    EXPECT_EQ(textured.positions, hinge(0.0f).positions);
    EXPECT_THAT(textured.uvs, SizeIs(4));

    Mesh colored = hinge(0.0f); // its vertices are pixels of a page, in the order of the file
    colored.positions.resize(104);
    finish(colored);
    EXPECT_THAT(colored.positions, SizeIs(104));
}

TEST(FinishMesh, AFanOfThousandsCostsNoMoreThanItsTriangles)
{
    constexpr uint32_t kRim = 200'000;
    Mesh mesh;
    mesh.positions.emplace_back(0.0f);
    for (uint32_t i = 0; i <= kRim; ++i) {
        const float angle = static_cast<float>(i) * 6.2831853f / kRim;
        mesh.positions.emplace_back(std::cos(angle), 0.0f, -std::sin(angle));
        if (i > 0) mesh.triangles.emplace_back(0, i, i + 1);
    }
    finish(mesh);
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 1, 0));
}

TEST(FinishMesh, WhatDoesNotFitTogetherIsRefused)
{
    Mesh mesh = hinge(0.0f);
    mesh.triangles[0].y = 4;
    EXPECT_THAT(refusal(mesh),
                HasSubstr("room.obj: mesh \"hinge\": refers to vertex 4, and it has 4"));
    mesh = hinge(0.0f);
    mesh.uvs.resize(3);
    EXPECT_THAT(refusal(mesh), HasSubstr("has not one texture coordinate a vertex"));
    mesh = hinge(0.0f);
    mesh.colors.resize(5);
    EXPECT_THAT(refusal(mesh), HasSubstr("has not one colour a vertex"));
}

TEST(FinishMesh, NothingIsLeftOfAMeshWithoutArea)
{
    Mesh mesh = hinge(0.0f);
    for (glm::vec3& p : mesh.positions) p = glm::vec3(1, 2, 3);
    EXPECT_THAT(finish(mesh), testing::ElementsAre(HasSubstr("2 triangles without area")));
    EXPECT_THAT(mesh.triangles, IsEmpty());
}

} // namespace relamp
