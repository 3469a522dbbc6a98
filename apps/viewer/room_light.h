#pragma once

#include "mailbox.h"
#include "relighting.h"
#include "room_drawing.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

/// The light on the walls that are drawn. It follows the newest that is set: soon at a glance, then
/// on every texel.
class RoomLight
{
public:
    struct Sinks
    {
        std::function<void(const std::string&)> failed; // on the thread of the mailbox
        std::function<void()> changed;                  // status; from any thread
    };
    RoomLight(RoomDrawing& drawing, Mailbox& mailbox, const relamp::EngineOptions& engine,
              Sinks sinks);

    /// As RelightingThread's. Lamps and sky are drawn at once.
    void setRoom(std::shared_ptr<const relamp::DelitRoom> room,
                 std::shared_ptr<const RoomMesh> mesh);
    void repaint(std::shared_ptr<const Paint> paint);
    void shine(relamp::Relighting lighting);
    void bake(const std::filesystem::path& file, const relamp::ViewOptions& view,
              std::function<void()> done);
    /// What is on the walls is not the light that counts.
    void outdate() { isGlanced_ = isRelit_ = false; }

    /// Whether the newest light is on the walls: glanced at, or found for every texel.
    [[nodiscard]] bool isGlanced() const { return isGlanced_ && !thread_.status().glances; }
    [[nodiscard]] bool isRelit() const { return isRelit_ && isGlanced(); }
    [[nodiscard]] double glanceMilliseconds() const { return glanceMilliseconds_; }
    [[nodiscard]] RelightingThread::Status status() const { return thread_.status(); }

private:
    void take(const std::vector<relamp::LightAtPlace>& atVertices, double milliseconds);
    void take(const std::vector<TexturePixels>& pages);

    RoomDrawing& drawing_;
    Mailbox& mailbox_;
    bool isGlanced_ = false;
    bool isRelit_ = false;
    double glanceMilliseconds_ = 0.0;
    RelightingThread thread_; // last: it uses all of these
};
