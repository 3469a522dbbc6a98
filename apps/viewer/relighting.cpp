#include "relighting.h"

#include "relamp/error.h"
#include "relamp/picture.h"

#include <chrono>
#include <new>
#include <utility>

namespace
{

using Clock = std::chrono::steady_clock;
constexpr auto kRest = std::chrono::milliseconds(350); // without a change, texels are worth it

std::vector<relamp::SurfacePlace> placesOf(const RoomMesh& mesh)
{
    std::vector<relamp::SurfacePlace> places;
    places.reserve(mesh.vertices.size());
    for (size_t v = 0; v < mesh.vertices.size(); ++v)
        places.push_back({mesh.vertices[v].position, mesh.normals[v]});
    return places;
}

} // namespace

/// What the thread works on.
struct RelightingThread::Room
{
    Room(std::shared_ptr<const relamp::DelitRoom> of, const RoomMesh& mesh,
         const relamp::EngineOptions& engine, relamp::Progress& progress)
        : room(std::move(of)),
          relighter(*room, {.transport = room->transport, .engine = engine}, progress),
          probes(relighter, placesOf(mesh))
    {}

    std::shared_ptr<const relamp::DelitRoom> room;
    relamp::Relighter relighter;
    relamp::LightProbes probes;
    std::shared_ptr<const Paint> paint; // none: the room's own
    relamp::Relighting light;
};

RelightingThread::RelightingThread(const Means& means, Sinks sinks)
    : means_(means), sinks_(std::move(sinks)),
      thread_([this](const std::stop_token& stop) { work(stop); })
{}

RelightingThread::~RelightingThread()
{
    thread_.request_stop();
    const std::lock_guard lock(mutex_);
    if (progress_) progress_->cancel();
}

void RelightingThread::setRoom(std::shared_ptr<const relamp::DelitRoom> room,
                               std::shared_ptr<const RoomMesh> mesh)
{
    {
        const std::lock_guard lock(mutex_);
        wantedRoom_ = std::move(room);
        wantedMesh_ = std::move(mesh);
        wantedPaint_ = nullptr;
        isRoomNew_ = true;
        needsRefining_ = false;
        if (progress_) progress_->cancel();
    }
    asked_.notify_one();
}

void RelightingThread::repaint(std::shared_ptr<const Paint> paint)
{
    {
        const std::lock_guard lock(mutex_);
        wantedPaint_ = std::move(paint);
        isLightNew_ = true;
        if (progress_ && needsRefining_) progress_->cancel();
        needsRefining_ = false;
    }
    asked_.notify_one();
}

void RelightingThread::setLight(relamp::Relighting lighting)
{
    {
        const std::lock_guard lock(mutex_);
        wantedLight_ = std::move(lighting);
        isLightNew_ = true;
        if (progress_ && needsRefining_) progress_->cancel(); // a glance is soon over by itself
        needsRefining_ = false;
    }
    asked_.notify_one();
}

void RelightingThread::bake(std::filesystem::path file, relamp::ViewOptions view,
                            std::function<void()> done)
{
    {
        const std::lock_guard lock(mutex_);
        baking_ = [file = std::move(file), view, done = std::move(done)](
                      relamp::Relighter& relighter, relamp::Progress& progress) {
            relamp::writeBaked(relighter, file, view, progress);
            done();
        };
    }
    asked_.notify_one();
}

RelightingThread::Status RelightingThread::status() const
{
    const std::lock_guard lock(mutex_);
    const bool bakes = baking_ != nullptr || isBaking_;
    return {isRoomNew_ || isLightNew_, needsRefining_ || bakes, stage_, fraction_, bakes};
}

std::shared_ptr<relamp::Progress> RelightingThread::begin()
{
    auto progress = std::make_shared<relamp::Progress>([this](const auto& event) {
        {
            const std::lock_guard lock(mutex_);
            stage_ = event.stage;
            fraction_ = event.fraction;
        }
        sinks_.changed();
    });
    const std::lock_guard lock(mutex_);
    progress_ = progress;
    return progress;
}

void RelightingThread::guard(const std::function<void(relamp::Progress&)>& step)
{
    const std::shared_ptr<relamp::Progress> progress = begin();
    std::string failure;
    try {
        step(*progress);
    } catch (const relamp::Error& error) {
        if (error.code() != relamp::ErrorCode::cancelled) failure = error.what();
    } catch (const std::bad_alloc&) {
        failure = "this machine has not enough memory to relight the room";
    } catch (const std::exception& error) {
        failure = error.what();
    }
    {
        const std::lock_guard lock(mutex_);
        progress_ = nullptr;
        stage_.clear();
        if (!failure.empty()) needsRefining_ = false;
    }
    if (!failure.empty()) sinks_.failed(failure);
    sinks_.changed();
}

void RelightingThread::work(const std::stop_token& stop)
{
    while (true) {
        bool isRoomNew = false;
        bool isLightNew = false;
        bool bakes = false;
        {
            std::unique_lock lock(mutex_);
            asked_.wait(lock, stop, [this] {
                return isRoomNew_ || (room_ && (isLightNew_ || needsRefining_ || baking_));
            });
            if (stop.stop_requested()) return;
            isRoomNew = isRoomNew_;
            isLightNew = isLightNew_;
            bakes = baking_ != nullptr;
        }
        if (isRoomNew)
            guard([this](relamp::Progress& progress) { adoptRoom(progress); });
        else if (isLightNew)
            glance();
        else if (bakes)
            writeBaked();
        else if (rests(stop))
            refine();
    }
}

void RelightingThread::adoptRoom(relamp::Progress& progress)
{
    std::shared_ptr<const relamp::DelitRoom> room;
    std::shared_ptr<const RoomMesh> mesh;
    {
        const std::lock_guard lock(mutex_);
        room = wantedRoom_;
        mesh = wantedMesh_;
        isRoomNew_ = false;
        isLightNew_ = true;
    }
    room_ = nullptr;
    if (room) room_ = std::make_unique<Room>(std::move(room), *mesh, means_.engine, progress);
}

void RelightingThread::glance()
{
    std::shared_ptr<const Paint> paint;
    {
        const std::lock_guard lock(mutex_);
        room_->light = wantedLight_;
        paint = wantedPaint_;
        isLightNew_ = false;
    }
    guard([&](relamp::Progress& progress) {
        const auto start = Clock::now();
        if (paint != room_->paint) {
            room_->relighter.repaint(paint->albedo, paint->confidence);
            room_->paint = std::move(paint);
        }
        room_->relighter.glance(room_->light, progress);
        std::vector<relamp::LightAtPlace> light = room_->probes.light(room_->relighter);
        const std::chrono::duration<double, std::milli> took = Clock::now() - start;
        {
            const std::lock_guard lock(mutex_);
            if (isRoomNew_) return;
            needsRefining_ = !isLightNew_;
        }
        sinks_.glance(std::move(light), took.count());
    });
}

bool RelightingThread::rests(const std::stop_token& stop)
{
    std::unique_lock lock(mutex_);
    return !asked_.wait_for(lock, stop, kRest, [this] {
        return isRoomNew_ || isLightNew_ || baking_;
    }) && !stop.stop_requested();
}

void RelightingThread::refine()
{
    guard([this](relamp::Progress& progress) {
        room_->relighter.light(room_->light, progress);
        std::vector<TexturePixels> pixels = PageShrinker(*room_->room->scan, means_.limits)(
            relamp::radianceOfPages(room_->relighter, progress), TexelFormat::rgb9e5);
        const std::lock_guard lock(mutex_);
        if (isRoomNew_ || isLightNew_) return;
        needsRefining_ = false;
        sinks_.textures(std::move(pixels));
    });
}

void RelightingThread::writeBaked()
{
    std::function<void(relamp::Relighter&, relamp::Progress&)> baking;
    {
        const std::lock_guard lock(mutex_);
        baking = std::exchange(baking_, nullptr);
        isBaking_ = true;
    }
    guard([&](relamp::Progress& progress) {
        room_->relighter.light(room_->light, progress);
        baking(room_->relighter, progress);
    });
    const std::lock_guard lock(mutex_);
    isBaking_ = false;
}
