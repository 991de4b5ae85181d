/* The albedo of rough gold from three views: what a furnace of white light shows of it. */
#include <specula.h>
#include <stdio.h>
#include <stdlib.h>

#define N 65536

static float u[N][3], wi[N][3], weight[N][3], pdf[N];
static uint8_t outcome[N];

static void check(specula_status status)
{
    if (status != SPECULA_STATUS_OK) {
        fprintf(stderr, "%s\n", specula_last_error());
        exit(EXIT_FAILURE);
    }
}

static float uniform(void)
{
    static uint32_t state = 1;
    state = state * 1664525u + 1013904223u;
    return (float)(state >> 8) / 16777216.0f;
}

int main(void)
{
    const float views[3][3] = {{0.0f, 0.0f, 1.0f}, {0.8f, 0.0f, 0.6f}, {0.96f, 0.0f, 0.28f}};
    specula_lobe *gold;
    check(specula_lobe_parse("conductor Au alpha 0.3", &gold));
    specula_batch_options options;
    check(specula_batch_options_init(&options, sizeof options));
    options.threads = 0; /* all */
    for (int view = 0; view < 3; view++) {
        for (int i = 0; i < N; i++)
            for (int c = 0; c < 3; c++)
                u[i][c] = uniform();
        const float *wo = views[view];
        const specula_input_f viewer = {wo, wo + 1, wo + 2, 0};
        const specula_input_f random = {u[0], u[0] + 1, u[0] + 2, 3};
        const specula_samples_f samples = {
            {wi[0], wi[0] + 1, wi[0] + 2, 3},
            {weight[0], weight[0] + 1, weight[0] + 2, 3},
            pdf,
            outcome,
        };
        check(specula_lobe_sample_f(gold, N, viewer, random, &options, &samples));
        double albedo[3] = {0.0, 0.0, 0.0};
        for (int i = 0; i < N; i++)
            for (int c = 0; c < 3; c++)
                albedo[c] += (double)weight[i][c] / N;
        printf("%.9f %.9f %.9f\n", albedo[0], albedo[1], albedo[2]);
    }
    specula_lobe_free(gold);
    return EXIT_SUCCESS;
}
