/* Embree 4 from its shared library, for `cargo xtask rays`: answers questions on standard input.
 *
 * Usage: embree_peer LIBRARY FOLDER THREADS, the folder holding what the chore wrote: positions.bin (f32,
 * three a vertex), triangles.bin (u32, three a triangle) and sets of rays (f32: origin, direction, t_max).
 *
 * First line out: seconds of processor and of the clock for the tree, bytes that it added to the memory.
 * Then, for every line `SET QUERY COUNT HINT`: seconds of processor for all rays of the set, and how many hit.
 * QUERY: `closest` or `any`; COUNT: rays a call, 1 or 16; HINT: `coherent` or `incoherent`, as Embree is told.
 * What puts rays into the order that Embree takes is not measured.
 *
 * The few declarations needed follow Embree's documentation of version 4. */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum {
    WIDTH = 16,
    /* Rays between two looks at the clock: they fit the second cache. */
    BLOCK = 1024,
    GEOMETRY_TRIANGLE = 0,
    BUFFER_INDEX = 0,
    BUFFER_VERTEX = 1,
    FORMAT_UINT3 = 0x5003,
    FORMAT_FLOAT3 = 0x9003,
    QUERY_COHERENT = 1 << 16,
};

/* A ray and its hit, in Embree's order. */
struct one {
    float origin[3], t_min, direction[3], time, t_max;
    uint32_t mask, id, flags;
    float normal[3], u, v;
    uint32_t primitive, geometry, instance[2];
} __attribute__((aligned(16)));

/* Sixteen of them. */
struct sixteen {
    float origin[3][WIDTH], t_min[WIDTH], direction[3][WIDTH], time[WIDTH], t_max[WIDTH];
    uint32_t mask[WIDTH], id[WIDTH], flags[WIDTH];
    float normal[3][WIDTH], u[WIDTH], v[WIDTH];
    uint32_t primitive[WIDTH], geometry[WIDTH], instance[2][WIDTH];
} __attribute__((aligned(64)));

struct arguments {
    uint32_t flags, features;
    void *context, *filter, *intersect;
    float least_width;
};

struct ray {
    float origin[3], direction[3], t_max;
};

static struct {
    void *(*new_device)(const char *);
    void *(*new_scene)(void *);
    void *(*new_geometry)(void *, int);
    void *(*new_buffer)(void *, int, unsigned, int, size_t, size_t);
    void (*commit_geometry)(void *);
    unsigned (*attach)(void *, void *);
    void (*commit_scene)(void *);
    void (*intersect)(void *, struct one *, struct arguments *);
    void (*occluded)(void *, struct one *, struct arguments *);
    void (*intersect_all)(const int *, void *, struct sixteen *, struct arguments *);
    void (*occluded_all)(const int *, void *, struct sixteen *, struct arguments *);
} embree;

static void fail(const char *what, const char *detail) {
    fprintf(stderr, "embree_peer: %s: %s\n", what, detail);
    exit(2);
}

static void find(void *library, const char *name, void *function) {
    void *found = dlsym(library, name);
    if (found == NULL) {
        fail("no such function", name);
    }
    memcpy(function, &found, sizeof found);
}

static void load_library(const char *path) {
    void *library = dlopen(path, RTLD_NOW);
    if (library == NULL) {
        fail(path, dlerror());
    }
    find(library, "rtcNewDevice", &embree.new_device);
    find(library, "rtcNewScene", &embree.new_scene);
    find(library, "rtcNewGeometry", &embree.new_geometry);
    find(library, "rtcSetNewGeometryBuffer", &embree.new_buffer);
    find(library, "rtcCommitGeometry", &embree.commit_geometry);
    find(library, "rtcAttachGeometry", &embree.attach);
    find(library, "rtcCommitScene", &embree.commit_scene);
    find(library, "rtcIntersect1", &embree.intersect);
    find(library, "rtcOccluded1", &embree.occluded);
    find(library, "rtcIntersect16", &embree.intersect_all);
    find(library, "rtcOccluded16", &embree.occluded_all);
}

/* The contents of FOLDER/NAME.bin, and of how many elements of `size` bytes. */
static void *load(const char *folder, const char *name, size_t size, size_t *count) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.bin", folder, name);
    FILE *file = fopen(path, "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0) {
        fail(path, "cannot be read");
    }
    size_t bytes = (size_t)ftell(file);
    rewind(file);
    void *data = malloc(bytes + 16);
    if (data == NULL || fread(data, 1, bytes, file) != bytes) {
        fail(path, "cannot be read");
    }
    fclose(file);
    *count = bytes / size;
    return data;
}

static double seconds(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double resident(void) {
    FILE *file = fopen("/proc/self/statm", "r");
    long whole = 0, pages = 0;
    if (file != NULL) {
        if (fscanf(file, "%ld %ld", &whole, &pages) != 2) {
            pages = 0;
        }
        fclose(file);
    }
    return (double)pages * (double)sysconf(_SC_PAGESIZE);
}

/* The tree, which is reported. */
static void *build(const char *folder, int threads) {
    size_t vertices, triangles;
    void *positions = load(folder, "positions", 3 * sizeof(float), &vertices);
    void *indices = load(folder, "triangles", 3 * sizeof(uint32_t), &triangles);
    double before = resident();
    double processor = seconds(CLOCK_PROCESS_CPUTIME_ID), clock = seconds(CLOCK_MONOTONIC);
    char configuration[64];
    snprintf(configuration, sizeof configuration, "threads=%d", threads);
    void *device = embree.new_device(configuration);
    if (device == NULL) {
        fail("rtcNewDevice", "no device");
    }
    void *scene = embree.new_scene(device);
    void *mesh = embree.new_geometry(device, GEOMETRY_TRIANGLE);
    memcpy(embree.new_buffer(mesh, BUFFER_VERTEX, 0, FORMAT_FLOAT3, 12, vertices), positions, 12 * vertices);
    memcpy(embree.new_buffer(mesh, BUFFER_INDEX, 0, FORMAT_UINT3, 12, triangles), indices, 12 * triangles);
    embree.commit_geometry(mesh);
    embree.attach(scene, mesh);
    embree.commit_scene(scene);
    processor = seconds(CLOCK_PROCESS_CPUTIME_ID) - processor;
    clock = seconds(CLOCK_MONOTONIC) - clock;
    printf("%.9f %.9f %.0f\n", processor, clock, resident() - before);
    fflush(stdout);
    free(positions);
    free(indices);
    return scene;
}

static struct arguments arguments(bool coherent) {
    struct arguments given = {coherent ? QUERY_COHERENT : 0, 0xffffffff, NULL, NULL, NULL, 0.0f};
    return given;
}

/* Seconds for one block, a ray a call; adds to the hits. */
static double one_by_one(void *scene, const struct ray *rays, size_t count, bool any, bool coherent, size_t *hits) {
    static struct one block[BLOCK];
    struct arguments given = arguments(coherent);
    for (size_t i = 0; i < count; i++) {
        struct one *one = &block[i];
        memset(one, 0, sizeof *one);
        memcpy(one->origin, rays[i].origin, sizeof one->origin);
        memcpy(one->direction, rays[i].direction, sizeof one->direction);
        one->t_max = rays[i].t_max;
        one->mask = one->geometry = one->instance[0] = UINT32_MAX;
    }
    double start = seconds(CLOCK_THREAD_CPUTIME_ID);
    for (size_t i = 0; i < count; i++) {
        if (any) {
            embree.occluded(scene, &block[i], &given);
        } else {
            embree.intersect(scene, &block[i], &given);
        }
    }
    double taken = seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    for (size_t i = 0; i < count; i++) {
        *hits += any ? block[i].t_max < 0.0f : block[i].geometry != UINT32_MAX;
    }
    return taken;
}

/* The same, sixteen a call. */
static double in_packets(void *scene, const struct ray *rays, size_t count, bool any, bool coherent, size_t *hits) {
    static struct sixteen block[BLOCK / WIDTH];
    static int valid[BLOCK / WIDTH][WIDTH] __attribute__((aligned(64)));
    struct arguments given = arguments(coherent);
    size_t packets = (count + WIDTH - 1) / WIDTH;
    memset(block, 0, packets * sizeof block[0]);
    for (size_t i = 0; i < packets * WIDTH; i++) {
        struct sixteen *packet = &block[i / WIDTH];
        size_t lane = i % WIDTH;
        valid[i / WIDTH][lane] = i < count ? -1 : 0;
        const struct ray *ray = &rays[i < count ? i : count - 1];
        for (int axis = 0; axis < 3; axis++) {
            packet->origin[axis][lane] = ray->origin[axis];
            packet->direction[axis][lane] = ray->direction[axis];
        }
        packet->t_max[lane] = ray->t_max;
        packet->mask[lane] = packet->geometry[lane] = packet->instance[0][lane] = UINT32_MAX;
    }
    double start = seconds(CLOCK_THREAD_CPUTIME_ID);
    for (size_t i = 0; i < packets; i++) {
        if (any) {
            embree.occluded_all(valid[i], scene, &block[i], &given);
        } else {
            embree.intersect_all(valid[i], scene, &block[i], &given);
        }
    }
    double taken = seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    for (size_t i = 0; i < count; i++) {
        const struct sixteen *packet = &block[i / WIDTH];
        size_t lane = i % WIDTH;
        *hits += any ? packet->t_max[lane] < 0.0f : packet->geometry[lane] != UINT32_MAX;
    }
    return taken;
}

int main(int count, char **words) {
    if (count != 4) {
        fail("usage", "embree_peer LIBRARY FOLDER THREADS");
    }
    load_library(words[1]);
    void *scene = build(words[2], atoi(words[3]));
    char name[64], query[16], hint[16], last[64] = "";
    int width;
    struct ray *rays = NULL;
    size_t length = 0;
    while (scanf("%63s %15s %d %15s", name, query, &width, hint) == 4) {
        if (strcmp(name, last) != 0) {
            free(rays);
            rays = load(words[2], name, sizeof *rays, &length);
            strcpy(last, name);
        }
        bool any = strcmp(query, "any") == 0, coherent = strcmp(hint, "coherent") == 0;
        double taken = 0.0;
        size_t hits = 0;
        for (size_t first = 0; first < length; first += BLOCK) {
            size_t block = length - first < BLOCK ? length - first : BLOCK;
            taken += width == WIDTH ? in_packets(scene, rays + first, block, any, coherent, &hits)
                                    : one_by_one(scene, rays + first, block, any, coherent, &hits);
        }
        printf("%.9f %zu\n", taken, hits);
        fflush(stdout);
    }
    free(rays);
    return 0;
}
