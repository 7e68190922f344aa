#include "harness/record/system_folder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/record/matrix_market.h"
#include "harness/record/output_folder.h"

enum { NAME = 80 };

/* What the tables are made of. */
typedef struct contents {
    const char *title;
    const scene *scene;
    const system_matrices *of;
} contents;

/* A matrix with its comment. */
typedef struct titled {
    const triplets *matrix;
    const char *comment;
} titled;

static void name_state(const contents *c, const state_matrices *s, char name[NAME])
{
    if (s->analysis == SCENE_NONE) {
        snprintf(name, NAME, "undeformed");
        return;
    }
    const char *kind = scene_analysis_name(c->scene->analysis[s->analysis].kind);
    if (s->station == SCENE_NONE)
        snprintf(name, NAME, "%s_%d", kind, s->analysis);
    else
        snprintf(name, NAME, "%s_%d_station_%d", kind, s->analysis, s->station);
}

/* The name that a scene that is written gives it, or nothing. */
static void name_cell(FILE *to, const char *list, int index)
{
    if (index != SCENE_NONE)
        fprintf(to, "%s_%d", list, index);
    fputc(',', to);
}

static void write_rows(FILE *to, const void *what)
{
    const system_matrices *s = ((const contents *)what)->of;
    fprintf(to, "row,node,member,along,component,unit,x,y,z\n");
    for (int i = 0; i < s->rows; i++) {
        const row_label *l = &s->label[i];
        fprintf(to, "%d,", i + 1);
        name_cell(to, "node", l->node);
        name_cell(to, "member", l->member);
        if (!isnan(l->along))
            fprintf(to, "%.17g", l->along);
        fprintf(to, ",%s,%s,%.17g,%.17g,%.17g\n", l->component, l->unit, l->position[0],
                l->position[1], l->position[2]);
    }
}

static void write_loads(FILE *to, const void *what)
{
    static const char *const kind[] = {"force",   "moment", "distributed", "distributed moment",
                                       "gravity", "gravity"};
    static const char *const unit[] = {"N", "N m", "N/m", "N m/m", "m/s^2", "m/s^2"};
    const scene *s = ((const contents *)what)->scene;
    fprintf(to, "column,kind,node,member,x,y,z,unit,axes,follower\n");
    for (int i = 0; i < s->loads; i++) {
        const scene_load *l = &s->load[i];
        const int along = scene_load_along(l);
        fprintf(to, "%d,%s,", i + 1, kind[l->kind]);
        name_cell(to, "node", along ? SCENE_NONE : l->where);
        name_cell(to, "member", along ? l->where : SCENE_NONE);
        fprintf(to, "%.17g,%.17g,%.17g,%s,%s,%d\n", l->vector[0], l->vector[1], l->vector[2],
                unit[l->kind], l->axes == SCENE_AXES_MEMBER ? "member" : "fixed", l->follower);
    }
}

static void write_states(FILE *to, const void *what)
{
    const contents *c = what;
    fprintf(to, "folder,analysis,kind,station,path\n");
    for (int i = 0; i < c->of->states; i++) {
        const state_matrices *s = &c->of->state[i];
        char name[NAME];
        name_state(c, s, name);
        fprintf(to, "%s,", name);
        name_cell(to, "analysis", s->analysis);
        if (s->analysis != SCENE_NONE)
            fprintf(to, "%s", scene_analysis_name(c->scene->analysis[s->analysis].kind));
        fputc(',', to);
        if (s->station != SCENE_NONE)
            fprintf(to, "%d", s->station);
        fprintf(to, ",%.17g\n", s->path);
    }
}

static void write_matrix(FILE *to, const void *what)
{
    const titled *t = what;
    matrix_market_write(to, t->matrix, t->comment);
}

/* A matrix without rows or columns is none. */
static status add_matrix(const output_folder *folder, const char *state, const char *letter,
                         const triplets *t, const char *comment, fault *f)
{
    char file[2 * NAME];
    const titled what = {t, comment};
    if (t->rows == 0 || t->columns == 0)
        return STATUS_OK;
    snprintf(file, sizeof file, "%s/%s.mtx", state, letter);
    return output_folder_file(folder, file, write_matrix, &what, f);
}

static status add_state(const output_folder *folder, const contents *c, const state_matrices *s,
                        fault *f)
{
    char name[NAME], comment[300];
    name_state(c, s, name);
    snprintf(comment, sizeof comment, "%.120s, %s; rows: dofs.csv, columns of B: loads.csv; SI",
             c->title, name);
    TRY(output_folder_below(folder, name, f));
    TRY(add_matrix(folder, name, "K", &s->K, comment, f));
    TRY(add_matrix(folder, name, "M", &s->M, comment, f));
    TRY(add_matrix(folder, name, "G", &s->G, comment, f));
    return add_matrix(folder, name, "B", &s->B, comment, f);
}

static status fill(const output_folder *folder, const contents *c, fault *f)
{
    TRY(output_folder_file(folder, "dofs.csv", write_rows, c, f));
    TRY(output_folder_file(folder, "loads.csv", write_loads, c, f));
    TRY(output_folder_file(folder, "states.csv", write_states, c, f));
    for (int i = 0; i < c->of->states; i++)
        TRY(add_state(folder, c, &c->of->state[i], f));
    return STATUS_OK;
}

status system_folder_write(const char *path, const char *title, const scene *s,
                           const system_matrices *of, fault *f)
{
    output_folder folder;
    const contents c = {title, s, of};
    TRY(output_folder_open(path, &folder, f));
    return output_folder_finish(&folder, fill(&folder, &c, f), f);
}
