/* Every function with NULL and with wrong arguments: a status, and a message that names what is wrong. */
#include <specula.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

static void expect(int line, specula_status got, specula_status wanted, const char *part)
{
    const char *message = specula_last_error();
    if (got == wanted && strstr(message, part) != NULL)
        return;
    printf("line %d: status %d, expected %d: '%s', expected '%s'\n", line, (int)got, (int)wanted, message, part);
    failures++;
}

#define WRONG(call, part) expect(__LINE__, call, SPECULA_STATUS_INVALID_ARGUMENT, part)
#define RIGHT(call) expect(__LINE__, call, SPECULA_STATUS_OK, "")
#define HOLDS(what)                                     \
    do {                                                \
        if (!(what)) {                                  \
            printf("line %d: " #what "\n", __LINE__);   \
            failures++;                                 \
        }                                               \
    } while (0)

static float f[6] = {0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f};
static double d[6] = {0.0, 0.0, 1.0, 0.0, 0.0, 1.0};
static const specula_input_f in_f = {f, f + 1, f + 2, 0}, no_in_f = {NULL, f, f, 0};
static const specula_input_d in_d = {d, d + 1, d + 2, 0}, no_in_d = {NULL, d, d, 0};
static float out_f[8], pdf_f[2];
static double out_d[8], pdf_d[2];
static uint8_t outcome[2];

static void versions(void)
{
    HOLDS(specula_abi_version() == SPECULA_ABI_VERSION);
    HOLDS(strlen(specula_version()) >= 5);
    HOLDS(strcmp(specula_last_error(), "") == 0);
}

static void lobes(void)
{
    specula_lobe *lobe = (specula_lobe *)f;
    bool is = false;
    double eta[3], k[3];
    specula_parameter alpha = {"alpha", NULL, {0.3, 0.0, 0.0}, 1};
    WRONG(specula_lobe_parse(NULL, &lobe), "text: is NULL");
    HOLDS(lobe == NULL);
    WRONG(specula_lobe_parse("lambert", NULL), "lobe: is NULL");
    WRONG(specula_lobe_parse("\xff", &lobe), "text: is not UTF-8");
    WRONG(specula_lobe_parse("conductor", &lobe), "alpha: is missing");
    WRONG(specula_lobe_make(NULL, &alpha, 1, &lobe), "kind: is NULL");
    WRONG(specula_lobe_make("conductor", NULL, 1, &lobe), "parameters: is NULL");
    WRONG(specula_lobe_make("conductor", &alpha, 1, NULL), "lobe: is NULL");
    WRONG(specula_lobe_make("lambert", &alpha, 1, &lobe), "no such parameter: 'alpha'");
    alpha.count = 4;
    WRONG(specula_lobe_make("conductor", &alpha, 1, &lobe), "alpha: expected a text, or 1 to 3 numbers, got 4");
    alpha.count = 1;
    alpha.text = "0.3";
    WRONG(specula_lobe_make("conductor", &alpha, 1, &lobe), "alpha: expected a text or numbers, got both");
    alpha.name = NULL;
    WRONG(specula_lobe_make("conductor", &alpha, 1, &lobe), "parameters.name: is NULL");
    WRONG(specula_lobe_measured(NULL, &lobe), "file: is NULL");
    WRONG(specula_lobe_measured("a.bsdf", NULL), "lobe: is NULL");
    expect(__LINE__, specula_lobe_measured("none.bsdf", &lobe), SPECULA_STATUS_UNREADABLE, "none.bsdf");
    HOLDS(lobe == NULL);
    WRONG(specula_lobe_is_stochastic(NULL, &is), "lobe: is NULL");
    WRONG(specula_lobe_is_specular(NULL, &is), "lobe: is NULL");
    WRONG(specula_metal(NULL, eta, k), "symbol: is NULL");
    WRONG(specula_metal("Au", NULL, k), "eta: is NULL");
    WRONG(specula_metal("Au", eta, NULL), "k: is NULL");
    WRONG(specula_metal("Xx", eta, k), "no such metal: 'Xx' (expected one of Ag");
    RIGHT(specula_lobe_make("lambert", NULL, 0, &lobe));
    WRONG(specula_lobe_is_stochastic(lobe, NULL), "is_stochastic: is NULL");
    WRONG(specula_lobe_is_specular(lobe, NULL), "is_specular: is NULL");
    specula_lobe_free(lobe);
    specula_lobe_free(NULL);
    RIGHT(specula_lobe_parse("smooth-conductor Au", &lobe));
    RIGHT(specula_lobe_is_specular(lobe, &is));
    HOLDS(is);
    RIGHT(specula_lobe_is_stochastic(lobe, &is));
    HOLDS(!is);
    specula_lobe_free(lobe);
    RIGHT(specula_metal("Au", eta, k));
    HOLDS(eta[0] > 0.0 && eta[2] > 1.4 && k[0] > 3.0);
}

static void batches_f(const specula_lobe *lobe)
{
    const specula_output_f to = {out_f, out_f + 1, out_f + 2, 3}, nowhere = {out_f, out_f + 1, NULL, 3};
    const specula_output_f one = {out_f, out_f + 1, out_f + 2, 0};
    specula_samples_f samples = {to, to, pdf_f, outcome};
    const size_t most = (size_t)-1;
    const specula_input_f rows = {f, f + 1, f + 2, 3};
    specula_input_f u = {f, f, f, 0};
    WRONG(specula_lobe_eval_f(NULL, 2, in_f, in_f, NULL, to), "lobe: is NULL");
    WRONG(specula_lobe_eval_f(lobe, 2, no_in_f, in_f, NULL, to), "wo.x: is NULL");
    WRONG(specula_lobe_eval_f(lobe, 2, in_f, no_in_f, NULL, to), "wi.x: is NULL");
    WRONG(specula_lobe_eval_f(lobe, 2, in_f, in_f, NULL, nowhere), "f_cos.z: is NULL");
    WRONG(specula_lobe_eval_f(lobe, 2, in_f, in_f, NULL, one), "f_cos.x: expected a stride of 1 or more, got 0");
    WRONG(specula_lobe_eval_f(lobe, most, rows, in_f, NULL, to), "wo.x: 18446744073709551615 elements");
    WRONG(specula_lobe_eval_f(lobe, 2, u, in_f, NULL, to), "wo[0]: expected a unit vector, got (0, 0, 0)");
    WRONG(specula_lobe_eval_f(lobe, 1, (specula_input_f){(float *)((char *)f + 1), f, f, 1}, in_f, NULL, to),
          "wo.x: is not aligned to 4 bytes");
    WRONG(specula_lobe_pdf_f(NULL, 2, in_f, in_f, NULL, pdf_f), "lobe: is NULL");
    WRONG(specula_lobe_pdf_f(lobe, 2, in_f, in_f, NULL, NULL), "pdf: is NULL");
    WRONG(specula_lobe_eval_pdf_f(NULL, 2, in_f, in_f, NULL, to, pdf_f), "lobe: is NULL");
    WRONG(specula_lobe_eval_pdf_f(lobe, 2, in_f, in_f, NULL, to, NULL), "pdf: is NULL");
    WRONG(specula_lobe_eval_pdf_f(lobe, 2, in_f, in_f, NULL, nowhere, pdf_f), "f_cos.z: is NULL");
    WRONG(specula_lobe_sample_f(NULL, 2, in_f, u, NULL, &samples), "lobe: is NULL");
    WRONG(specula_lobe_sample_f(lobe, 2, in_f, u, NULL, NULL), "samples: is NULL");
    WRONG(specula_lobe_sample_f(lobe, 2, in_f, no_in_f, NULL, &samples), "u.x: is NULL");
    WRONG(specula_lobe_sample_f(lobe, 2, in_f, rows, NULL, &samples),
          "u[0]: expected numbers in [0, 1), got (0, 0, 1)");
    samples.outcome = NULL;
    WRONG(specula_lobe_sample_f(lobe, 2, in_f, u, NULL, &samples), "outcome: is NULL");
    samples.pdf = NULL;
    WRONG(specula_lobe_sample_f(lobe, 2, in_f, u, NULL, &samples), "pdf: is NULL");
    samples.weight = nowhere;
    WRONG(specula_lobe_sample_f(lobe, 2, in_f, u, NULL, &samples), "weight.z: is NULL");
    samples.wi = nowhere;
    WRONG(specula_lobe_sample_f(lobe, 2, in_f, u, NULL, &samples), "wi.z: is NULL");
    /* No elements: no arrays. */
    RIGHT(specula_lobe_eval_f(lobe, 0, (specula_input_f){NULL, NULL, NULL, 1}, in_f, NULL, nowhere));
}

static void batches_d(const specula_lobe *lobe)
{
    const specula_output_d to = {out_d, out_d + 1, out_d + 2, 3}, nowhere = {out_d, NULL, out_d, 3};
    const specula_samples_d samples = {to, to, pdf_d, outcome};
    const specula_input_d rows = {d, d + 1, d + 2, 3};
    WRONG(specula_lobe_eval_d(NULL, 2, in_d, in_d, NULL, to), "lobe: is NULL");
    WRONG(specula_lobe_eval_d(lobe, 2, no_in_d, in_d, NULL, to), "wo.x: is NULL");
    WRONG(specula_lobe_eval_d(lobe, 2, in_d, in_d, NULL, nowhere), "f_cos.y: is NULL");
    WRONG(specula_lobe_pdf_d(lobe, 2, in_d, no_in_d, NULL, pdf_d), "wi.x: is NULL");
    WRONG(specula_lobe_pdf_d(lobe, 2, in_d, in_d, NULL, NULL), "pdf: is NULL");
    WRONG(specula_lobe_eval_pdf_d(lobe, 2, in_d, in_d, NULL, nowhere, pdf_d), "f_cos.y: is NULL");
    WRONG(specula_lobe_sample_d(lobe, 2, in_d, rows, NULL, &samples), "u[0]: expected numbers in [0, 1)");
    WRONG(specula_lobe_sample_d(lobe, 2, in_d, rows, NULL, NULL), "samples: is NULL");
}

static void batch_options(const specula_lobe *lobe)
{
    const specula_output_f to = {out_f, out_f + 1, out_f + 2, 3};
    /* Of a header that has more. */
    struct {
        specula_batch_options known;
        uint64_t unknown;
    } newer;
    specula_batch_options options;
    memset(&options, 0, sizeof options);
    WRONG(specula_batch_options_init(NULL, sizeof options), "options: is NULL");
    WRONG(specula_batch_options_init(&options, 3), "options: a size of 3 bytes");
    WRONG(specula_lobe_eval_f(lobe, 2, in_f, in_f, &options, to), "options: a size of 0 bytes (expected 24 or more");
    RIGHT(specula_batch_options_init(&options, sizeof options));
    HOLDS(options.size == sizeof options && options.threads == 1 && options.seed == 0);
    RIGHT(specula_lobe_eval_f(lobe, 2, in_f, in_f, &options, to));
    options.transport = 2;
    WRONG(specula_lobe_eval_f(lobe, 2, in_f, in_f, &options, to), "options.transport: expected 0 (radiance)");
    RIGHT(specula_batch_options_init(&newer.known, sizeof newer));
    HOLDS(newer.known.size == sizeof newer && newer.unknown == 0);
    RIGHT(specula_lobe_eval_f(lobe, 2, in_f, in_f, &newer.known, to));
    newer.unknown = 1;
    WRONG(specula_lobe_eval_f(lobe, 2, in_f, in_f, &newer.known, to), "options: something is set that this version");
}

static int stop(double share_done, double samples_per_pixel, void *user)
{
    (void)share_done, (void)samples_per_pixel;
    *(int *)user += 1;
    return 1;
}

static void pictures(specula_picture *picture)
{
    uint32_t width = 0, height = 0;
    WRONG(specula_picture_size(NULL, &width, &height), "picture: is NULL");
    WRONG(specula_picture_size(picture, NULL, &height), "width: is NULL");
    WRONG(specula_picture_size(picture, &width, NULL), "height: is NULL");
    RIGHT(specula_picture_size(picture, &width, &height));
    HOLDS(width == 8 && height == 4);
    WRONG(specula_picture_read(NULL, 0, out_f, 96, 0, 0), "picture: is NULL");
    WRONG(specula_picture_read(picture, 0, NULL, 96, 0, 0), "to: is NULL");
    WRONG(specula_picture_read(picture, 9, out_f, 96, 0, 0), "layer: there is no layer 9");
    WRONG(specula_picture_read(picture, 0, out_f, 95, 0, 0), "room: expected 96 floats or more, got 95");
    WRONG(specula_picture_read(picture, 0, out_f, 96, 2, 0), "pixel_stride: expected 3 floats or more, or 0, got 2");
    WRONG(specula_picture_read(picture, 0, out_f, 96, 3, 23), "row_stride: expected 24 floats or more, or 0, got 23");
    WRONG(specula_picture_read(picture, 0, out_f, 96, (size_t)-1, 0), "room: expected 18446744073709551615 floats");
    WRONG(specula_picture_write(NULL, "a.png"), "picture: is NULL");
    WRONG(specula_picture_write(picture, NULL), "path: is NULL");
    WRONG(specula_picture_write(picture, "a.gif"), "path: expected a name that ends with .exr or .png, got 'a.gif'");
    expect(__LINE__, specula_picture_write(picture, "none/a.exr"), SPECULA_STATUS_UNWRITABLE, "none/");
    specula_picture_free(picture);
    specula_picture_free(NULL);
}

static void scenes(void)
{
    specula_scene *scene = (specula_scene *)f;
    specula_picture *picture = (specula_picture *)f;
    specula_render_options options;
    uint32_t width = 0, height = 0;
    size_t count = 0;
    const char *text = "";
    int calls = 0;
    WRONG(specula_scene_load(NULL, &scene), "path: is NULL");
    HOLDS(scene == NULL);
    WRONG(specula_scene_load("a.pbrt", NULL), "scene: is NULL");
    expect(__LINE__, specula_scene_load("none.pbrt", &scene), SPECULA_STATUS_UNREADABLE, "none.pbrt");
    WRONG(specula_scene_builtin(NULL), "scene: is NULL");
    WRONG(specula_scene_resolution(NULL, &width, &height), "scene: is NULL");
    WRONG(specula_scene_warning_count(NULL, &count), "scene: is NULL");
    WRONG(specula_scene_warning(NULL, 0, &text), "scene: is NULL");
    HOLDS(text == NULL);
    WRONG(specula_render(NULL, NULL, NULL, NULL, &picture), "scene: is NULL");
    HOLDS(picture == NULL);
    WRONG(specula_render_options_init(NULL, sizeof options), "options: is NULL");
    WRONG(specula_render_options_init(&options, 3), "options: a size of 3 bytes");
    RIGHT(specula_scene_builtin(&scene));
    WRONG(specula_scene_resolution(scene, NULL, &height), "width: is NULL");
    WRONG(specula_scene_resolution(scene, &width, NULL), "height: is NULL");
    RIGHT(specula_scene_resolution(scene, &width, &height));
    HOLDS(width == 960 && height == 400);
    WRONG(specula_scene_warning_count(scene, NULL), "count: is NULL");
    RIGHT(specula_scene_warning_count(scene, &count));
    WRONG(specula_scene_warning(scene, count, &text), "index: expected one below 0, got 0");
    WRONG(specula_scene_warning(scene, 0, NULL), "text: is NULL");
    WRONG(specula_render(scene, NULL, NULL, NULL, NULL), "picture: is NULL");
    RIGHT(specula_render_options_init(&options, sizeof options));
    HOLDS(options.size == sizeof options && options.max_depth == -1);
    options.width = 8;
    WRONG(specula_render(scene, &options, NULL, NULL, &picture), "options.width, options.height: expected both");
    options.height = 4;
    options.noise = -1.0;
    WRONG(specula_render(scene, &options, NULL, NULL, &picture), "options.noise: expected 0 for none");
    options.noise = 0.0;
    options.seconds = -1.0;
    WRONG(specula_render(scene, &options, NULL, NULL, &picture), "options.seconds: expected 0 for none");
    options.seconds = 0.0;
    options.max_depth = -2;
    WRONG(specula_render(scene, &options, NULL, NULL, &picture), "options.max_depth: expected -1");
    options.max_depth = -1;
    options.samples_per_pixel = (uint32_t)-1;
    WRONG(specula_render(scene, &options, NULL, NULL, &picture), "options.samples_per_pixel: expected 0");
    options.samples_per_pixel = 64;
    expect(__LINE__, specula_render(scene, &options, stop, &calls, &picture), SPECULA_STATUS_CANCELLED, "progress");
    HOLDS(picture != NULL && calls == 1);
    specula_scene_free(scene);
    specula_scene_free(NULL);
    pictures(picture);
}

int main(void)
{
    specula_lobe *lobe;
    versions();
    lobes();
    RIGHT(specula_lobe_parse("conductor Au alpha 0.3", &lobe));
    batches_f(lobe);
    batches_d(lobe);
    batch_options(lobe);
    specula_lobe_free(lobe);
    scenes();
    if (failures == 0)
        puts("all as expected");
    return failures;
}
