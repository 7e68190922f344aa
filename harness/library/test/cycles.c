/* The command `cycles COUNT` makes and frees scenes, solutions and documents repeatedly. It prints
 * the bytes in use after COUNT/10 cycles and after COUNT further cycles, and fails if they increase
 * by more than 100 for each further cycle. make lab L=valgrind runs the program with valgrind. */
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>

#include "harness/library/test/leaf.h"

static void cycle(void)
{
    char *why = NULL, *json = NULL;
    bw_scene *s = NULL, *bad = NULL;
    bw_result *r = NULL;
    const double *values;
    size_t points;
    if (bw_scene_read(leaf, sizeof leaf - 1, "leaf", &s, &why) != BW_OK ||
        bw_solve(s, "beamw", 1, "{\"shapes\": 2}", &r, &why) != BW_OK ||
        bw_result_json(r, &json, &why) != BW_OK) {
        fprintf(stderr, "%s\n", why);
        exit(1);
    }
    bw_free_text(json);
    bw_result_steps(r, "path", &values);
    bw_result_shapes(r, &points, &values);
    bw_scene_free(s);
    bw_result_free(r);
    if (bw_scene_read("a: [", 4, NULL, &bad, &why) != BW_REFUSED)
        exit(1);
    bw_free_text(why);
}

static void big_cycle(void)
{
    char *json = NULL;
    bw_scene *s = NULL;
    bw_result *r = NULL;
    if (bw_scene_case("sheet_cantilever", &s, NULL) != BW_OK ||
        bw_scene_set(s, "thickness=1e-3", NULL) != BW_OK ||
        bw_solve(s, "sheet_third", 1, NULL, &r, NULL) != BW_OK ||
        bw_scene_write(s, &json, NULL) != BW_OK)
        exit(1);
    bw_free_text(json);
    bw_result_free(r);
    bw_scene_free(s);
}

static void run(int count)
{
    for (int i = 0; i < count; i++) {
        cycle();
        if (i % 100 == 0)
            big_cycle();
    }
}

static long in_use(void)
{
    const struct mallinfo2 now = mallinfo2();
    return (long)(now.uordblks + now.hblkhd);
}

int main(int count, char **arguments)
{
    const int cycles = count > 1 ? atoi(arguments[1]) : 1000;
    run(cycles / 10);
    const long before = in_use();
    run(cycles);
    const long after = in_use();
    printf("%d cycles: %ld bytes in use before, %ld after\n", cycles, before, after);
    return cycles < 1 || after - before > 100L * cycles;
}
