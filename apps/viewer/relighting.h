#pragma once

#include "room_mesh.h"
#include "solving.h"
#include "texture_pixels.h"

#include "relamp/light_probes.h"
#include "relamp/relight.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

/// Follows the light that a person sets: at once with light at the vertices of what is drawn, and,
/// where it rests, with that of every texel.
///
/// A thread of its own owns the relighter; the newest light counts, and interrupts the slow half.
class RelightingThread
{
public:
    struct Sinks // called from the thread
    {
        std::function<void(std::vector<relamp::LightAtPlace>, double milliseconds)> glance;
        std::function<void(std::vector<TexturePixels>)> textures; // of the newest light
        std::function<void(const std::string&)> failed;
        std::function<void()> changed; // status
    };
    struct Means
    {
        relamp::EngineOptions engine; // as RelightOptions
        TextureLimits limits;         // of the textures that it delivers
    };
    RelightingThread(const Means& means, Sinks sinks);
    ~RelightingThread();
    RelightingThread(const RelightingThread&) = delete;
    RelightingThread& operator=(const RelightingThread&) = delete;

    /// Another room, drawn as `mesh`; none if null.
    void setRoom(std::shared_ptr<const relamp::DelitRoom> room,
                 std::shared_ptr<const RoomMesh> mesh);
    /// Another albedo of that room.
    void repaint(std::shared_ptr<const Paint> paint);
    void setLight(relamp::Relighting lighting);
    /// Writes the light that was set as `relamp::writeBaked` does, then calls `done`.
    void bake(std::filesystem::path file, relamp::ViewOptions view, std::function<void()> done);

    struct Status
    {
        bool glances = false; // the newest light is not even glanced at
        bool refines = false; // texels are not as they will be
        std::string stage;
        double fraction = 0.0;
        bool bakes = false; // a file is wanted, or being written
    };
    [[nodiscard]] Status status() const;

private:
    struct Room;
    void work(const std::stop_token& stop);
    void adoptRoom(relamp::Progress& progress);
    void glance();
    bool rests(const std::stop_token& stop);
    void refine();
    void writeBaked();
    std::shared_ptr<relamp::Progress> begin();
    void guard(const std::function<void(relamp::Progress&)>& step);

    Means means_;
    Sinks sinks_;
    mutable std::mutex mutex_;
    std::condition_variable_any asked_;
    std::shared_ptr<const relamp::DelitRoom> wantedRoom_;
    std::shared_ptr<const RoomMesh> wantedMesh_;
    std::shared_ptr<const Paint> wantedPaint_; // none: the room's own
    relamp::Relighting wantedLight_;
    bool isRoomNew_ = false;
    bool isLightNew_ = false;
    bool needsRefining_ = false;
    std::function<void(relamp::Relighter&, relamp::Progress&)> baking_; // what is wanted
    bool isBaking_ = false;
    std::shared_ptr<relamp::Progress> progress_;
    std::string stage_;
    double fraction_ = 0.0;
    std::unique_ptr<Room> room_; // of the thread alone
    std::jthread thread_;
};
