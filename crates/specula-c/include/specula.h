/* Specula: microfacet BSDFs over arrays, scenes, renders and pictures.
 *
 * Made from the sources; a change here is lost.
 *
 * - Functions that can fail return `specula_status`; `specula_last_error` has the words. A pointer that is NULL is an
 *   error with the argument's name, unless the function says otherwise.
 * - Texts are in UTF-8 and end with a zero.
 * - Lobes, scenes and pictures never change: any number of threads may use one at a time. Who gets one frees it.
 * - Options begin with their size, so that they can grow: `specula_..._init` sets it, and the defaults.
 * - Directions are unit and point away from the surface, whose normal is z. `wo` leads to the viewer and is given,
 *   `wi` to the light and is sampled.
 */

#ifndef SPECULA_H
#define SPECULA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/**
 * Version of this interface, which `specula_abi_version` returns, too. Programs that were compiled for an older one
 * with the same number run with a newer library.
 */
#define SPECULA_ABI_VERSION 1

/**
 * `wo` leads to the camera: radiance is scaled by 1/eta^2 on refraction.
 */
#define SPECULA_TRANSPORT_RADIANCE 0

/**
 * `wo` leads to a light: importance is not scaled.
 */
#define SPECULA_TRANSPORT_IMPORTANCE 1

/**
 * Textures are filtered as the scene says.
 */
#define SPECULA_TEXTURE_FILTER_SCENE 0

/**
 * Pictures are interpolated bilinearly, not over footprints.
 */
#define SPECULA_TEXTURE_FILTER_BILINEAR 1

/**
 * Over footprints, trilinearly.
 */
#define SPECULA_TEXTURE_FILTER_TRILINEAR 2

/**
 * Over footprints, by elliptical Gaussian means.
 */
#define SPECULA_TEXTURE_FILTER_EWA 3

/**
 * Outcome of a sample: no direction; `wi`, `weight` and `pdf` are zero.
 */
#define SPECULA_OUTCOME_REJECTED 0

/**
 * Outcome of a sample: `wi` on the side of `wo`.
 */
#define SPECULA_OUTCOME_REFLECTION 1

/**
 * Outcome of a sample: `wi` on the other side.
 */
#define SPECULA_OUTCOME_TRANSMISSION 2

/**
 * Outcome of a sample: a mirrored direction; `pdf` is its probability.
 */
#define SPECULA_OUTCOME_SPECULAR_REFLECTION 3

/**
 * Outcome of a sample: a refracted or straight direction; `pdf` is its probability.
 */
#define SPECULA_OUTCOME_SPECULAR_TRANSMISSION 4

/**
 * Layer of 3 channels: radiance times exposure, in linear sRGB.
 */
#define SPECULA_LAYER_COLOUR 0

/**
 * Layer of 3 channels: albedo of the first visible surface.
 */
#define SPECULA_LAYER_ALBEDO 1

/**
 * Layer of 3 channels: shading normal of the first visible surface, in the world.
 */
#define SPECULA_LAYER_NORMAL 2

/**
 * Layer of 1 channel: distance along the camera ray to the first visible surface, in scene units; 0 where none is.
 */
#define SPECULA_LAYER_DEPTH 3

/**
 * Layer of 1 channel: samples taken.
 */
#define SPECULA_LAYER_SAMPLE_COUNT 4

/**
 * Layer of 3 channels: estimated variance of the colour.
 */
#define SPECULA_LAYER_VARIANCE 5

/**
 * How a call ended.
 */
typedef enum {
  /**
   * It did what it was asked to.
   */
  SPECULA_STATUS_OK = 0,
  /**
   * An argument that the function does not take.
   */
  SPECULA_STATUS_INVALID_ARGUMENT = 1,
  /**
   * A file that cannot be read, or that is damaged.
   */
  SPECULA_STATUS_UNREADABLE = 2,
  /**
   * A file that cannot be written.
   */
  SPECULA_STATUS_UNWRITABLE = 3,
  /**
   * The progress function ended a render.
   */
  SPECULA_STATUS_CANCELLED = 4,
  /**
   * There is not so much memory.
   */
  SPECULA_STATUS_OUT_OF_MEMORY = 5,
  /**
   * A fault of the library.
   */
  SPECULA_STATUS_INTERNAL = 6,
} specula_status;

/**
 * A lobe: what a surface does with light. `specula_lobe_free` frees it.
 */
typedef struct specula_lobe specula_lobe;

/**
 * A picture: layers of pixels. `specula_picture_free` frees it.
 */
typedef struct specula_picture specula_picture;

/**
 * A scene: shapes, materials, lights and a camera. `specula_scene_free` frees it.
 */
typedef struct specula_scene specula_scene;

/**
 * A parameter of a lobe: a name with a text, or with one to three numbers.
 */
typedef struct {
  /**
   * Such as "alpha"; hyphens and underscores are the same.
   */
  const char *name;
  /**
   * A value as in `specula_lobe_parse`, such as "Au"; NULL where there are numbers.
   */
  const char *text;
  /**
   * A number, two alphas, or the channels of a colour in linear sRGB.
   */
  double numbers[3];
  /**
   * How many numbers there are, 1 to 3; 0 with a text.
   */
  size_t count;
} specula_parameter;

/**
 * How elements are computed. `specula_batch_options_init` sets the defaults.
 */
typedef struct {
  /**
   * Size of this struct in bytes, as the caller's header has it.
   */
  size_t size;
  /**
   * Of lobes that are themselves estimates: each element has its own stream of random numbers. 0 by default.
   */
  uint64_t seed;
  /**
   * SPECULA_TRANSPORT_RADIANCE by default.
   */
  uint32_t transport;
  /**
   * Threads that share the work; 0: all of the machine; 1 by default. The result does not depend on it.
   */
  uint32_t threads;
} specula_batch_options;

/**
 * Vectors to read, in single precision: element `i` is (x[i * stride], y[i * stride], z[i * stride]).
 *
 * * An array per component: their addresses, and a stride of 1.
 * * Rows of three: `p`, `p + 1`, `p + 2`, and a stride of 3.
 * * One vector for all elements: the addresses of its components, and a stride of 0.
 */
typedef struct {
  /**
   * First components.
   */
  const float *x;
  /**
   * Second components.
   */
  const float *y;
  /**
   * Third components: along the surface's normal.
   */
  const float *z;
  /**
   * Numbers from one element to the next; 0: one for all.
   */
  size_t stride;
} specula_input_f;

/**
 * Vectors or colours to write, in single precision, laid out as `specula_input_f`. Components do not overlap.
 */
typedef struct {
  /**
   * First components; red.
   */
  float *x;
  /**
   * Second components; green.
   */
  float *y;
  /**
   * Third components; blue.
   */
  float *z;
  /**
   * Numbers from one element to the next, 1 or more.
   */
  size_t stride;
} specula_output_f;

/**
 * Vectors to read, in double precision: element `i` is (x[i * stride], y[i * stride], z[i * stride]).
 *
 * * An array per component: their addresses, and a stride of 1.
 * * Rows of three: `p`, `p + 1`, `p + 2`, and a stride of 3.
 * * One vector for all elements: the addresses of its components, and a stride of 0.
 */
typedef struct {
  /**
   * First components.
   */
  const double *x;
  /**
   * Second components.
   */
  const double *y;
  /**
   * Third components: along the surface's normal.
   */
  const double *z;
  /**
   * Numbers from one element to the next; 0: one for all.
   */
  size_t stride;
} specula_input_d;

/**
 * Vectors or colours to write, in double precision, laid out as `specula_input_d`. Components do not overlap.
 */
typedef struct {
  /**
   * First components; red.
   */
  double *x;
  /**
   * Second components; green.
   */
  double *y;
  /**
   * Third components; blue.
   */
  double *z;
  /**
   * Numbers from one element to the next, 1 or more.
   */
  size_t stride;
} specula_output_d;

/**
 * Where samples go, in single precision; every array is wanted.
 */
typedef struct {
  /**
   * Directions to the light, unit; zero where rejected.
   */
  specula_output_f wi;
  /**
   * f |cos| / pdf, for red, green and blue; zero where rejected.
   */
  specula_output_f weight;
  /**
   * One per element: in 1/sr, or a probability where the outcome is specular; zero where rejected.
   */
  float *pdf;
  /**
   * One per element: SPECULA_OUTCOME_...
   */
  uint8_t *outcome;
} specula_samples_f;

/**
 * Where samples go, in double precision; every array is wanted.
 */
typedef struct {
  /**
   * Directions to the light, unit; zero where rejected.
   */
  specula_output_d wi;
  /**
   * f |cos| / pdf, for red, green and blue; zero where rejected.
   */
  specula_output_d weight;
  /**
   * One per element: in 1/sr, or a probability where the outcome is specular; zero where rejected.
   */
  double *pdf;
  /**
   * One per element: SPECULA_OUTCOME_...
   */
  uint8_t *outcome;
} specula_samples_d;

/**
 * What a render is asked for. `specula_render_options_init` sets the defaults.
 */
typedef struct {
  /**
   * Size of this struct in bytes, as the caller's header has it.
   */
  size_t size;
  /**
   * Samples per pixel; 0, the default: as many as the scene says, or as the noise or the time take.
   */
  uint32_t samples_per_pixel;
  /**
   * Renders with different seeds are independent; 0 by default.
   */
  uint32_t seed;
  /**
   * Threads; 0, the default: all of the machine. The picture does not depend on it.
   */
  uint32_t threads;
  /**
   * Columns of the picture; 0, the default: those of the scene. Either both are given or none.
   */
  uint32_t width;
  /**
   * Rows of the picture; 0, the default: those of the scene.
   */
  uint32_t height;
  /**
   * Longest path in scattering events; 0 shows emission only; -1, the default: as the scene says.
   */
  int32_t max_depth;
  /**
   * Estimated relative error at which the picture is done, such as 0.02; 0, the default: none. Samples are spread
   * by their error and cost.
   */
  double noise;
  /**
   * Seconds after which the render ends; 0, the default: none. One sample of each pixel is taken in any case.
   */
  double seconds;
  /**
   * SPECULA_TEXTURE_FILTER_SCENE by default.
   */
  uint32_t texture_filter;
  /**
   * 1: normal maps are filtered into roughness, by LEAN mapping; 0 by default: their mean normal alone is left.
   */
  uint32_t filter_normal_maps;
} specula_render_options;

/**
 * Tells how far a render is, in the thread that called `specula_render`.
 *
 * * `share_done`: in [0, 1].
 * * `samples_per_pixel`: samples so far, on average.
 * * `user`: the pointer that was given to `specula_render`.
 * * Returns: 0 to go on; anything else ends the render. No exception may leave it.
 */
typedef int (*specula_progress)(double share_done, double samples_per_pixel, void *user);

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Returns SPECULA_ABI_VERSION of the library. May be called from any thread.
 */
uint32_t specula_abi_version(void);

/**
 * Returns the version of the library, such as "0.1.0", which stays valid. May be called from any thread.
 */
const char *specula_version(void);

/**
 * Returns the message of the last call in this thread that failed, in UTF-8; "" before the first one.
 *
 * It names the argument and says what was expected. Valid until the next call in this thread; not to be freed.
 */
const char *specula_last_error(void);

/**
 * Makes a lobe of a text, such as "conductor Au alpha 0.3".
 *
 * The text is a kind and then keys with their values, in any order, between white space. Values have no spaces:
 * numbers, words, `true` or `false`, two alphas along x and y as 0.1,0.4, colours in linear sRGB as 0.8,0.2,0.1 or as
 * one number for a grey. What is not given has the default in brackets; alphas without one must be given.
 *
 * ```text
 * lambert                 albedo [0.5]
 * eon                     albedo [0.5], roughness [0.5]: rough diffuse reflection
 * diffuse-transmission    reflectance, transmittance [0.25]
 * smooth-conductor        a reflectance
 * conductor               a reflectance, alpha, distribution [ggx] or beckmann, sampler [exact], bounded, cap or
 *                         heitz, masking [height-correlated] or separable, energy turquin, turquin-series or
 *                         kulla-conty
 * multibounce-conductor   a reflectance, alpha, distribution, model [specula], heitz, bitterli, wang,
 *                         wang-uncorrelated, cui or cui-bidirectional, mis_pdf [normalised], hapke or lambert
 * smooth-dielectric       eta [1.5], reflection_tint [1], transmission_tint [1]
 * thin-dielectric         the same: a pane
 * dielectric              the same, alpha, distribution, sampler [cap], masking, compensated [false]
 * multibounce-dielectric  eta, tints, alpha, distribution, model [specula] or heitz, mis_pdf
 * coated-diffuse          alpha (smooth without), eta [1.5], albedo [0.5], thickness [0], max_depth (no limit
 *                         without), scattering [lossless] or single
 * layered                 alpha (smooth without), eta [1.5], the base's albedo or a reflectance with base_alpha
 *                         (smooth without), thickness [0], medium_albedo [0], g [0]
 * plastic                 alpha (smooth without), eta [1.49], diffuse [0.5], specular [1], nonlinear [false],
 *                         distribution, masking [separable]
 * principled              base_color [0.5], roughness [0.5], anisotropic, metallic, spec_trans, eta [1.5], spec_tint,
 *                         sheen, sheen_tint, clearcoat, clearcoat_gloss, flatness, diff_trans [all 0], thin [false],
 *                         outside [true]
 * gltf                    base_color, metallic, roughness [1], anisotropy [0], ior [1.5], specular, specular_color
 *                         [1], transmission [0], volume [false], outside [true], clearcoat, clearcoat_roughness,
 *                         sheen_color, sheen_roughness [0], compensated [false]
 * ```
 *
 * A reflectance is one of these, white without: the chemical symbol of a measured metal, alone or after
 * `reflectance`; a colour after `reflectance`; `conductor_eta` and `conductor_k`; `f0` (Schlick), and with it
 * `f82_tint`. `tint` is a factor on any.
 *
 * * `text`: UTF-8, ends with a zero.
 * * `lobe`: where the lobe goes, NULL where the call fails. The caller frees it by `specula_lobe_free`.
 * * Returns: SPECULA_STATUS_INVALID_ARGUMENT where the text is no lobe; the message lists what is known.
 *
 * May be called from any thread.
 */
specula_status specula_lobe_parse(const char *text,
                                  specula_lobe **lobe);

/**
 * Makes a lobe of parameters: what `specula_lobe_parse` does, without a text.
 *
 * * `kind`: such as "conductor".
 * * `parameters`: `count` of them; may be NULL where there are none.
 * * `lobe`: as for `specula_lobe_parse`.
 * * Returns: SPECULA_STATUS_INVALID_ARGUMENT where the parameters make no lobe.
 *
 * May be called from any thread.
 */
specula_status specula_lobe_make(const char *kind,
                                 const specula_parameter *parameters,
                                 size_t count,
                                 specula_lobe **lobe);

/**
 * Reads a measured material, which reflects light as a gonioreflectometer has measured it.
 *
 * Its samples have a density of their own (Dupuy and Jakob 2018, "An Adaptive Parameterization for Efficient Material
 * Acquisition and Rendering"). It is black where either direction is below the horizon.
 *
 * * `file`: path of a `.bsdf` file of the RGL database, or of a `.binary` file of the MERL database; UTF-8.
 * * `lobe`: as for `specula_lobe_parse`.
 * * Returns: SPECULA_STATUS_UNREADABLE where the file cannot be read, or is no such file.
 *
 * May be called from any thread.
 */
specula_status specula_lobe_measured(const char *file,
                                     specula_lobe **lobe);

/**
 * Frees a lobe, which no thread may use any more; NULL is nothing.
 */
void specula_lobe_free(specula_lobe *lobe);

/**
 * Tells whether values of a lobe are estimates, each with random numbers of its own, as of walks.
 *
 * * `is_stochastic`: where the answer goes.
 *
 * May be called from any thread.
 */
specula_status specula_lobe_is_stochastic(const specula_lobe *lobe, bool *is_stochastic);

/**
 * Tells whether nothing but Dirac deltas is left of a lobe, as of a mirror.
 *
 * * `is_specular`: where the answer goes.
 *
 * May be called from any thread.
 */
specula_status specula_lobe_is_specular(const specula_lobe *lobe, bool *is_specular);

/**
 * Gives the complex index of refraction of a measured metal, eta + i k, for red, green and blue of linear sRGB.
 *
 * * `symbol`: its chemical symbol, such as "Au".
 * * `eta`, `k`: room for 3 numbers each.
 * * Returns: SPECULA_STATUS_INVALID_ARGUMENT where it is not among the measured; the message lists them.
 *
 * May be called from any thread.
 */
specula_status specula_metal(const char *symbol,
                             double *eta,
                             double *k);

/**
 * Sets the defaults of options.
 *
 * * `options`: room for `size` bytes.
 * * `size`: `sizeof(specula_batch_options)` of the caller's header.
 *
 * May be called from any thread.
 */
specula_status specula_batch_options_init(specula_batch_options *options, size_t size);

/**
 * Evaluates a lobe: f(wo, wi) |cos theta_i|, in 1/sr, without Dirac deltas.
 *
 * * `n`: elements; where it is 0, arrays may be NULL.
 * * `wo`, `wi`: directions to the viewer and to the light: unit, in the surface's frame, whose normal is z.
 * * `options`: NULL for the defaults.
 * * `f_cos`: `n` colours. It may lie on `wo` or `wi` with the same addresses and stride, but not overlap otherwise.
 * * Returns: SPECULA_STATUS_INVALID_ARGUMENT where a vector is not unit; the message names the first, and some
 *   elements before it may have been written. Nothing is written outside of the `n` elements.
 *
 * May be called from any thread, by several with one lobe.
 */
specula_status specula_lobe_eval_f(const specula_lobe *lobe,
                                   size_t n,
                                   specula_input_f wo,
                                   specula_input_f wi,
                                   const specula_batch_options *options,
                                   specula_output_f f_cos);

/**
 * `specula_lobe_eval_f` in double precision.
 */
specula_status specula_lobe_eval_d(const specula_lobe *lobe,
                                   size_t n,
                                   specula_input_d wo,
                                   specula_input_d wi,
                                   const specula_batch_options *options,
                                   specula_output_d f_cos);

/**
 * Gives the density with which `specula_lobe_sample_f` samples `wi`, in 1/sr, without Dirac deltas.
 *
 * * `pdf`: `n` numbers.
 * * All else: as for `specula_lobe_eval_f`.
 */
specula_status specula_lobe_pdf_f(const specula_lobe *lobe,
                                  size_t n,
                                  specula_input_f wo,
                                  specula_input_f wi,
                                  const specula_batch_options *options,
                                  float *pdf);

/**
 * `specula_lobe_pdf_f` in double precision.
 */
specula_status specula_lobe_pdf_d(const specula_lobe *lobe,
                                  size_t n,
                                  specula_input_d wo,
                                  specula_input_d wi,
                                  const specula_batch_options *options,
                                  double *pdf);

/**
 * Does `specula_lobe_eval_f` and `specula_lobe_pdf_f` together, at little more than the price of one.
 */
specula_status specula_lobe_eval_pdf_f(const specula_lobe *lobe,
                                       size_t n,
                                       specula_input_f wo,
                                       specula_input_f wi,
                                       const specula_batch_options *options,
                                       specula_output_f f_cos,
                                       float *pdf);

/**
 * `specula_lobe_eval_pdf_f` in double precision.
 */
specula_status specula_lobe_eval_pdf_d(const specula_lobe *lobe,
                                       size_t n,
                                       specula_input_d wo,
                                       specula_input_d wi,
                                       const specula_batch_options *options,
                                       specula_output_d f_cos,
                                       double *pdf);

/**
 * Samples directions to the light.
 *
 * * `wo`: directions to the viewer, as for `specula_lobe_eval_f`.
 * * `u`: three uniform random numbers in [0, 1) per element: the first chooses among lobes, the others the direction.
 * * `samples`: where the results go; arrays that overlap neither one another nor the inputs, but for the same
 *   addresses and stride.
 * * All else: as for `specula_lobe_eval_f`.
 */
specula_status specula_lobe_sample_f(const specula_lobe *lobe,
                                     size_t n,
                                     specula_input_f wo,
                                     specula_input_f u,
                                     const specula_batch_options *options,
                                     const specula_samples_f *samples);

/**
 * `specula_lobe_sample_f` in double precision.
 */
specula_status specula_lobe_sample_d(const specula_lobe *lobe,
                                     size_t n,
                                     specula_input_d wo,
                                     specula_input_d u,
                                     const specula_batch_options *options,
                                     const specula_samples_d *samples);

/**
 * Reads a scene of pbrt-v4, Mitsuba's XML or glTF 2.0, or a single mesh (OBJ, PLY); the content tells which.
 *
 * * `path`: the file, in UTF-8.
 * * `scene`: where the scene goes, NULL where the call fails. The caller frees it by `specula_scene_free`.
 * * Returns: SPECULA_STATUS_UNREADABLE where there is no scene in it; the message begins with file, line and column.
 *
 * May be called from any thread.
 */
specula_status specula_scene_load(const char *path,
                                  specula_scene **scene);

/**
 * Makes the built-in scene: orbs of metal and glass, 960 x 400 pixels, 64 samples per pixel.
 *
 * * `scene`: as for `specula_scene_load`.
 *
 * May be called from any thread.
 */
specula_status specula_scene_builtin(specula_scene **scene);

/**
 * Gives the size of a scene's picture in pixels.
 *
 * May be called from any thread.
 */
specula_status specula_scene_resolution(const specula_scene *scene,
                                        uint32_t *width,
                                        uint32_t *height);

/**
 * Gives the number of warnings that a scene was read with: what is rendered otherwise than the file says.
 *
 * May be called from any thread.
 */
specula_status specula_scene_warning_count(const specula_scene *scene,
                                           size_t *count);

/**
 * Gives a warning: file, line, column and what differs, in UTF-8.
 *
 * * `index`: from 0.
 * * `text`: where its address goes, which is valid until the scene is freed.
 *
 * May be called from any thread.
 */
specula_status specula_scene_warning(const specula_scene *scene, size_t index, const char **text);

/**
 * Frees a scene, which no thread may use any more; NULL is nothing.
 */
void specula_scene_free(specula_scene *scene);

/**
 * Sets the defaults of options.
 *
 * * `options`: room for `size` bytes.
 * * `size`: `sizeof(specula_render_options)` of the caller's header.
 *
 * May be called from any thread.
 */
specula_status specula_render_options_init(specula_render_options *options, size_t size);

/**
 * Renders a scene on the CPU.
 *
 * * `options`: NULL for the defaults.
 * * `progress`: called after every pass over the picture and about 20 times a second; may be NULL.
 * * `user`: given to `progress`; may be NULL.
 * * `picture`: where the picture goes, NULL where the call fails. The caller frees it by `specula_picture_free`.
 * * Returns: SPECULA_STATUS_CANCELLED where `progress` ended the render: the picture so far is given all the same.
 *   SPECULA_STATUS_OUT_OF_MEMORY where the render would take more than there is.
 *
 * The same options give the same picture bit for bit, unless a time ends it. May be called from any thread, by several
 * with one scene.
 */
specula_status specula_render(const specula_scene *scene,
                              const specula_render_options *options,
                              specula_progress progress,
                              void *user,
                              specula_picture **picture);

/**
 * Gives the size of a picture in pixels.
 *
 * May be called from any thread.
 */
specula_status specula_picture_size(const specula_picture *picture,
                                    uint32_t *width,
                                    uint32_t *height);

/**
 * Copies a layer of a picture, rows from the top. Channel `c` of pixel (x, y) goes to
 * `to[y * row_stride + x * pixel_stride + c]`.
 *
 * * `layer`: SPECULA_LAYER_...
 * * `to`: an array of `room` floats.
 * * `pixel_stride`: floats from one pixel to the next; 0: as many as there are channels.
 * * `row_stride`: floats from one row to the next; 0: `width * pixel_stride`.
 * * Returns: SPECULA_STATUS_INVALID_ARGUMENT where there is too little room; the message says how much is needed.
 *
 * May be called from any thread.
 */
specula_status specula_picture_read(const specula_picture *picture,
                                    uint32_t layer,
                                    float *to,
                                    size_t room,
                                    size_t pixel_stride,
                                    size_t row_stride);

/**
 * Writes a picture: all layers as OpenEXR, or the colours as PNG in 8-bit sRGB. A file of that name is replaced whole.
 *
 * * `path`: UTF-8; it ends with .exr or .png.
 * * Returns: SPECULA_STATUS_UNWRITABLE where the file cannot be written.
 *
 * May be called from any thread.
 */
specula_status specula_picture_write(const specula_picture *picture,
                                     const char *path);

/**
 * Frees a picture, which no thread may use any more; NULL is nothing.
 */
void specula_picture_free(specula_picture *picture);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SPECULA_H */
