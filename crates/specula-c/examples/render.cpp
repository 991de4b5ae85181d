// The built-in scene, small, as a PNG: render FILE
#include <cstdio>
#include <memory>
#include <specula.h>
#include <stdexcept>

namespace {

void check(specula_status status)
{
    if (status != SPECULA_STATUS_OK)
        throw std::runtime_error(specula_last_error());
}

struct Free {
    void operator()(specula_scene *scene) const { specula_scene_free(scene); }
    void operator()(specula_picture *picture) const { specula_picture_free(picture); }
};

std::unique_ptr<specula_scene, Free> builtin()
{
    specula_scene *scene = nullptr;
    check(specula_scene_builtin(&scene));
    return std::unique_ptr<specula_scene, Free>(scene);
}

int progress(double share_done, double samples_per_pixel, void *user)
{
    std::fprintf(stderr, "\r%3.0f %%, %.0f samples", 100 * share_done, samples_per_pixel);
    *static_cast<double *>(user) = share_done;
    return 0;
}

} // namespace

int main(int count, char **arguments)
try {
    if (count != 2)
        throw std::runtime_error("usage: render FILE");
    const auto scene = builtin();
    specula_render_options options;
    check(specula_render_options_init(&options, sizeof options));
    options.width = 96;
    options.height = 40;
    options.samples_per_pixel = 4;
    double share_done = 0.0;
    specula_picture *rendered = nullptr;
    check(specula_render(scene.get(), &options, progress, &share_done, &rendered));
    const std::unique_ptr<specula_picture, Free> picture(rendered);
    check(specula_picture_write(picture.get(), arguments[1]));
    std::fprintf(stderr, "\n");
    std::printf("%.0f %%\n", 100 * share_done);
} catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
