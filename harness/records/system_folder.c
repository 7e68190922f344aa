#include "harness/records/system_folder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/scene/names.h"
#include "harness/records/csv_record.h"
#include "harness/records/matrix_market.h"
#include "harness/records/output_folder.h"

enum { NAME = 96 };
static const char undeformed[] = "undeformed";
static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789-+";

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

/* Name of an analysis; what no folder can be called stands as '_'. */
static scene_words plain_folder(const scene *s, int analysis)
{
    scene_words out;
    if (scene_own_name(s, SCENE_ANALYSES, analysis)[0] != '\0')
        out = scene_name(s, SCENE_ANALYSES, analysis);
    else
        snprintf(out.text, sizeof out.text, "%s_%d",
                 scene_analysis_name(s->analysis[analysis].kind), analysis);
    for (char *c = out.text; *c != '\0'; c++)
        if (strchr(letters, *c) == NULL)
            *c = '_';
    return out;
}

static scene_words folder_of(const scene *s, int analysis)
{
    scene_words out = plain_folder(s, analysis);
    int taken = strcmp(out.text, undeformed) == 0;
    for (int i = 0; i < analysis; i++)
        taken |= strcmp(out.text, plain_folder(s, i).text) == 0;
    if (taken)
        snprintf(out.text, sizeof out.text, "%.40s_%d", plain_folder(s, analysis).text, analysis);
    return out;
}

static void name_state(const contents *c, const state_matrices *s, char name[NAME])
{
    if (s->analysis == SCENE_NONE) {
        snprintf(name, NAME, "%s", undeformed);
        return;
    }
    const scene_words analysis = folder_of(c->scene, s->analysis);
    if (s->station == SCENE_NONE)
        snprintf(name, NAME, "%s", analysis.text);
    else
        snprintf(name, NAME, "%s_station_%d", analysis.text, s->station);
}

/* Its name or nothing, as a field of CSV. */
static void name_cell(FILE *to, const scene *s, scene_list list, int index)
{
    if (index != SCENE_NONE)
        csv_record_text(to, scene_name(s, list, index).text);
    fputc(',', to);
}

static void write_rows(FILE *to, const void *what)
{
    const contents *c = what;
    const system_matrices *s = c->of;
    fprintf(to, "row,node,member,along,component,unit,x,y,z\n");
    for (int i = 0; i < s->rows; i++) {
        const row_label *l = &s->label[i];
        fprintf(to, "%d,", i + 1);
        name_cell(to, c->scene, SCENE_NODES, l->node);
        name_cell(to, c->scene, SCENE_MEMBERS, l->member);
        if (!isnan(l->along))
            fprintf(to, "%.17g", l->along);
        fprintf(to, ",%s,%s,%.17g,%.17g,%.17g\n", l->component, l->unit, l->position[0],
                l->position[1], l->position[2]);
    }
}

/* What of its member a load acts on, and its vector where that ends; nothing of one at a node. */
static void write_extent(FILE *to, const scene_load *l)
{
    const double *last = l->varies ? l->last : l->vector;
    if (scene_load_along(l))
        fprintf(to, ",%.17g,%.17g,%.17g,%.17g,%.17g,%d\n", l->range[0], l->range[1], last[0],
                last[1], last[2], l->lumped);
    else
        fputs(",,,,,,\n", to);
}

static void write_loads(FILE *to, const void *what)
{
    static const char *const kind[] = {"force",   "moment",  "distributed", "distributed moment",
                                       "gravity", "gravity", "force",       "moment"};
    static const char *const unit[] = {"N", "N m", "N/m", "N m/m", "m/s^2", "m/s^2", "N", "N m"};
    const scene *s = ((const contents *)what)->scene;
    fprintf(to, "column,kind,node,member,x,y,z,unit,axes,follower,from,to,x_to,y_to,z_to,lumped\n");
    for (int i = 0; i < s->loads; i++) {
        const scene_load *l = &s->load[i];
        const int along = scene_load_along(l);
        fprintf(to, "%d,%s,", i + 1, kind[l->kind]);
        name_cell(to, s, SCENE_NODES, along ? SCENE_NONE : l->where);
        name_cell(to, s, SCENE_MEMBERS, along ? l->where : SCENE_NONE);
        fprintf(to, "%.17g,%.17g,%.17g,%s,%s,%d", l->vector[0], l->vector[1], l->vector[2],
                unit[l->kind], l->axes == SCENE_AXES_MEMBER ? "member" : "fixed", l->follower);
        write_extent(to, l);
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
        name_cell(to, c->scene, SCENE_ANALYSES, s->analysis);
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
    TRY(add_matrix(folder, name, "M_inside", &s->inside, comment, f));
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
