#include "room_light.h"

#include "lamp_shapes.h"

#include <algorithm>
#include <utility>

RoomLight::RoomLight(RoomDrawing& drawing, Mailbox& mailbox, const relamp::EngineOptions& engine,
                     Sinks sinks)
    : drawing_(drawing), mailbox_(mailbox),
      thread_({engine, drawing.limits()},
              {.glance =
                   [this](std::vector<relamp::LightAtPlace> light, double milliseconds) {
                       mailbox_.post([this, light = std::move(light), milliseconds] {
                           take(light, milliseconds);
                       });
                   },
               .textures =
                   [this](std::vector<TexturePixels> pages) {
                       mailbox_.post([this, pages = std::move(pages)] { take(pages); });
                   },
               .failed =
                   [this, failed = std::move(sinks.failed)](const std::string& sentence) {
                       mailbox_.post([failed, sentence] { failed(sentence); });
                   },
               .changed = std::move(sinks.changed)})
{}

void RoomLight::take(const std::vector<relamp::LightAtPlace>& atVertices, double milliseconds)
{
    drawing_.removeTextures(PageTexture::relit);
    drawing_.setLight(atVertices);
    glanceMilliseconds_ = milliseconds;
    isGlanced_ = !status().glances;
}

void RoomLight::take(const std::vector<TexturePixels>& pages)
{
    if (status().glances || status().refines) return; // out of date
    for (size_t p = 0; p < std::min(pages.size(), drawing_.pages()); ++p)
        drawing_.setTexture(p, PageTexture::relit, pages[p]);
    isRelit_ = true;
}

void RoomLight::setRoom(std::shared_ptr<const relamp::DelitRoom> room,
                        std::shared_ptr<const RoomMesh> mesh)
{
    outdate();
    thread_.setRoom(std::move(room), std::move(mesh));
}

void RoomLight::repaint(std::shared_ptr<const Paint> paint)
{
    outdate();
    thread_.repaint(std::move(paint));
}

void RoomLight::shine(relamp::Relighting lighting)
{
    drawing_.setLamps(lampShapes(lighting.lights));
    drawing_.setSky(lighting.sky);
    outdate();
    thread_.setLight(std::move(lighting));
}

void RoomLight::bake(const std::filesystem::path& file, const relamp::ViewOptions& view,
                     std::function<void()> done)
{
    thread_.bake(file, view, [this, done = std::move(done)] { mailbox_.post(done); });
}
