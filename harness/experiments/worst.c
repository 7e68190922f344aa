#include "harness/experiments/worst.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/write.h"
#include "harness/experiments/ranges_points.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

static void write_text(FILE *to, const void *text)
{
    fputs(text, to);
}

/* The scene of a point as a text, which the caller frees; "" where no file can say it. */
static status text_of(const parameter_ranges *r, long index, char **text, fault *f)
{
    double at[CASE_MAX_PARAMETERS], value[CASE_MAX_PARAMETERS];
    char where[FAULT_TEXT], summary[2 * FAULT_TEXT];
    const case_type *type = r->request.type;
    scene s;
    fault why;
    TRY(design_points(&r->design, index, 1, at, f));
    ranges_points_values(r, at, value);
    ranges_points_text(r, at, where, sizeof where);
    snprintf(summary, sizeof summary, "%.200s, at %s", type->summary, where);
    const write_head head = {type->name, summary, type->source};
    const status built = cell_scene(type, value, NULL, &s, &why);
    *text = write_scene_text(built == STATUS_OK ? &s : NULL, &head);
    scene_free(&s);
    return *text != NULL ? STATUS_OK : fault_set(f, STATUS_FAULT, "out of memory for a scene");
}

/* Its name, where an earlier one of the list is the same point. */
static const char *name_known(const tally *t, int which, int k, long index)
{
    for (int i = 0; i <= which; i++)
        for (int j = 0; j < t->worsts[i] && (i < which || j < k); j++)
            if (t->worst[i][j].point == index)
                return t->worst[i][j].scene;
    return NULL;
}

static status write_one(const output_folder *folder, tally *t, int which, int k, fault *f)
{
    tally_worst *w = &t->worst[which][k];
    char name[TALLY_SCENE], *text;
    const char *other = name_known(t, which, k, w->point);
    if (other != NULL) {
        snprintf(w->scene, sizeof w->scene, "%s", other);
        return STATUS_OK;
    }
    TRY(text_of(t->of, w->point, &text, f));
    snprintf(name, sizeof name, "point_%ld.yaml", w->point);
    status outcome = STATUS_OK;
    if (text[0] != '\0') {
        outcome = output_folder_file(folder, name, write_text, text, f);
        snprintf(w->scene, sizeof w->scene, "%s", name);
    }
    free(text);
    return outcome;
}

static status write_all(const output_folder *folder, tally *t, fault *f)
{
    for (int i = 0; i < t->of->formulations; i++)
        for (int k = 0; k < t->worsts[i]; k++)
            TRY(write_one(folder, t, i, k, f));
    return STATUS_OK;
}

status worst_write(const char *folder, tally *t, fault *f)
{
    output_folder out;
    TRY(output_folder_open(folder, &out, f));
    return output_folder_finish(&out, write_all(&out, t, f), f);
}
