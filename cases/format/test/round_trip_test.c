/* For every case and every parameter point with a reference value, writing the scene to a file and
 * reading it must give the same scene bit for bit. */
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>

#include "cases/format/format.h"
#include "cases/format/test/same_scene.h"
#include "cases/scene/scene.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

static char *written(const scene *s, const case_type *type, size_t *size)
{
    char *text = NULL;
    FILE *to = open_memstream(&text, size);
    fault f = {""};
    const write_head head = {type->name, type->summary, type->source};
    const status outcome = write_scene(to, s, &head, &f);
    fclose(to);
    gsl_test(outcome != STATUS_OK, "%s: written (%s)", type->name, f.text);
    return text;
}

static void check_point(const sweep_point *p)
{
    size_t size = 0;
    char *text = written(&p->scene, p->type, &size);
    scene_file *file = NULL;
    mistakes m;
    fault f = {""};
    char words[FAULT_TEXT] = "";
    gsl_test(scene_looks_foreign(&p->scene, words), "%s/%s: in SI (%s)", p->type->name, p->name,
             words);
    const status read = scene_file_read_bytes(text, size, p->type->name, &file, &m, &f);
    gsl_test(read != STATUS_OK, "%s/%s: read (%s)", p->type->name, p->name, f.text);
    if (read == STATUS_OK) {
        scene again;
        int index;
        const double none[CASE_MAX_PARAMETERS] = {0};
        scene_init(&again, p->type->name);
        gsl_test(case_build(scene_file_case(file), none, &again, &f) != STATUS_OK, "%s/%s: built",
                 p->type->name, p->name);
        const char *what = differing(&p->scene, &again, &index);
        gsl_test(what != NULL, "%s/%s: the same scene; %s %d differs", p->type->name, p->name,
                 what != NULL ? what : "nothing", index);
        scene_free(&again);
    }
    scene_file_free(file);
    free(text);
}

int main(void)
{
    const char *path = getenv("BEAMWORK_TRUTHS");
    const sweep_request request = {.jobs = 1};
    truths t;
    sweep s;
    fault f = {""};
    if (truths_read(path != NULL ? path : "build/truths.h5", &t, &f) != STATUS_OK ||
        plan_sweep(&request, &t, &s, &f) != STATUS_OK) {
        gsl_test(1, "%s", f.text);
        return gsl_test_summary();
    }
    int checked = 0;
    for (int i = 0; i < s.points; i++)
        if (s.point[i].status == STATUS_OK) {
            check_point(&s.point[i]);
            checked++;
        }
    gsl_test(checked < 100, "%d points of all cases", checked);
    printf("%d points\n", checked);
    sweep_free(&s);
    truths_free(&t);
    return gsl_test_summary();
}
