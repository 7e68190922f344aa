#include "harness/records/records_impl.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"

static void write_lines(FILE *to, int parts, csv_part row[], int value)
{
    const subject s = row[value].s;
    const quantity_result *r = s.record;
    quantity_result one = *r;
    one.status = STATUS_OK;
    one.reason[0] = '\0';
    row[value].s.record = &one;
    row[value].s.truth = row[value].s.model_truth = NULL;
    for (int i = 0; i < r->curve.points; i++) {
        one.x = r->curve.x[i];
        one.value = r->curve.value[i];
        csv_record_line(to, parts, row);
    }
    row[value].s = s;
    if (r->curve.points == 0 || r->status != STATUS_OK)
        csv_record_line(to, parts, row);
}

void csv_solution(FILE *to, const sweep *s)
{
    const gathering g = {s, NULL, NULL};
    subjects list = {0};
    const subject cell = gather_cell(&g, 0, 0);
    csv_part row[] = {{&record_quantity, cell}, {&record_omission, cell}};
    gather_mesh(&g, &record_quantity, 0, 0, &list);
    csv_record_head(to, 2, row);
    for (int i = 0; i < list.count; i++) {
        row[0].s = list.row[i];
        write_lines(to, 2, row, 0);
    }
    gather_free(&list);
}

static void list_meshes(FILE *to, const gathering *g, int with_truth, int parts, csv_part row[])
{
    const sweep *s = g->sweep;
    csv_record_head(to, parts, row);
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].missing[0] == '\0')
            for (int k = 0; k < s->series[i].meshes; k++) {
                subjects list = {0};
                gather_mesh(g, &record_quantity, i, k, &list);
                for (int q = 0; q < list.count; q++) {
                    for (int part = 0; part < parts; part++) {
                        const record_type *type = row[part].type;
                        row[part].s = type == &record_quantity ? list.row[q] : gather_cell(g, i, k);
                        if (type == &record_timing)
                            row[part].s.record = &s->series[i].timing[k];
                    }
                    if (!with_truth)
                        write_lines(to, parts, row, 0);
                    else if (list.row[q].truth != NULL)
                        csv_record_line(to, parts, row);
                }
                gather_free(&list);
            }
}

void csv_convergence(FILE *to, const sweep *s, const truths *t)
{
    csv_part row[] = {{.type = &record_quantity}, {.type = &record_cell}};
    list_meshes(to, &(gathering){s, NULL, t}, 0, 2, row);
}

void csv_timing(FILE *to, const sweep *s, const evaluation *j)
{
    csv_part row[] = {{.type = &record_timing}, {.type = &record_quantity}, {.type = &record_cell}};
    list_meshes(to, &(gathering){s, j, NULL}, 1, 3, row);
}

enum { MOST_COLUMNS = 2 * SCHEMA_MOST_FIELDS };

typedef struct record_column {
    const schema_field *field;
    int part;
} record_column;

static void csv_field(FILE *to, const char *text)
{
    fputc('"', to);
    for (; *text != '\0'; text++) {
        if (*text == '"')
            fputc('"', to);
        fputc(*text, to);
    }
    fputc('"', to);
}

static void csv_record_text(FILE *to, const char *text)
{
    if (text[strcspn(text, "\",\r\n")] == '\0')
        fputs(text, to);
    else
        csv_field(to, text);
}

static int known(const record_column out[], int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (strcmp(out[i].field->name, name) == 0)
            return 1;
    return 0;
}

static int columns_of(int parts, const csv_part part[], record_column out[MOST_COLUMNS])
{
    int count = 0;
    for (int p = 0; p < parts; p++) {
        const schema_field *list[SCHEMA_MOST_FIELDS];
        const int fields = schema_fields(part[p].type, KEY_AROUND, list);
        for (int i = 0; i < fields && count < MOST_COLUMNS; i++)
            if (list[i]->count == 0 && !known(out, count, list[i]->name))
                out[count++] = (record_column){list[i], p};
    }
    return count;
}

static void write_value(FILE *to, const schema_field *which, const field_value *v)
{
    if (which->kind == FIELD_TEXT)
        csv_field(to, v->text);
    else if (which->kind == FIELD_ENUM)
        fputs(v->text, to);
    else if (which->kind != FIELD_DOUBLE)
        fprintf(to, "%ld", v->whole);
    else if (isfinite(*v->numbers))
        fprintf(to, "%.17g", *v->numbers);
}

void csv_record_head(FILE *to, int parts, const csv_part part[])
{
    record_column list[MOST_COLUMNS];
    const int count = columns_of(parts, part, list);
    for (int i = 0; i < count; i++)
        fprintf(to, "%s%s", i > 0 ? "," : "", list[i].field->name);
    fputc('\n', to);
}

void csv_record_line(FILE *to, int parts, const csv_part part[])
{
    record_column list[MOST_COLUMNS];
    const int count = columns_of(parts, part, list);
    for (int i = 0; i < count; i++) {
        field_value v;
        schema_read(&part[list[i].part].s, list[i].field, &v);
        if (i > 0)
            fputc(',', to);
        write_value(to, list[i].field, &v);
    }
    fputc('\n', to);
}

/* Writes a matrix in the Matrix Market coordinate format (R. F. Boisvert, R. Pozo, K. A. Remington,
 * NISTIR 5935, 1996) with 17 digits. comment: one line; NULL: no comment. */
static void matrix_market_write(FILE *to, const triplets *t, const char *comment)
{
    static const char *const kind[] = {"general", "symmetric", "skew-symmetric"};
    fprintf(to, "%%%%MatrixMarket matrix coordinate real %s\n", kind[t->kind]);
    if (comment != NULL)
        fprintf(to, "%% %s\n", comment);
    fprintf(to, "%d %d %d\n", t->rows, t->columns, t->entries);
    for (int i = 0; i < t->entries; i++)
        fprintf(to, "%d %d %.17g\n", t->row[i] + 1, t->column[i] + 1, t->value[i]);
}

enum { NAME = 96, TITLE = 300 };
static const char undeformed[] = "undeformed";
static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789-+";

typedef struct contents {
    const char *title;
    const scene *scene;
    const system_matrices *of;
    const reduced_model *reduced;
} contents;

typedef struct titled {
    const triplets *matrix;
    const char *comment;
} titled;

/* Returns the name of an analysis, in which '_' replaces characters that a folder name cannot
 * contain. */
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

/* Writes the range of the member on which a load acts, and the vector of the load at the end of
 * this range. Writes empty fields for a load on a node. */
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
    static const char *const kind[] = {"force",      "moment",  "distributed", "distributed moment",
                                       "gravity",    "gravity", "force",       "moment",
                                       "temperature"};
    static const char *const unit[] = {"N",     "N m", "N/m", "N m/m", "m/s^2",
                                       "m/s^2", "N",   "N m", "K"};
    const scene *s = ((const contents *)what)->scene;
    fprintf(to, "column,kind,node,member,x,y,z,unit,axes,follower,from,to,x_to,y_to,z_to,lumped\n");
    for (int i = 0; i < s->loads; i++) {
        const scene_load *l = &s->load[i];
        const int along = scene_load_along(l);
        fprintf(to, "%d,%s,", i + 1, l->elongation != 0 ? "elongation" : kind[l->kind]);
        name_cell(to, s, SCENE_NODES, along ? SCENE_NONE : l->where);
        name_cell(to, s, SCENE_MEMBERS, along ? l->where : SCENE_NONE);
        fprintf(to, "%.17g,%.17g,%.17g,%s,%s,%d", l->vector[0], l->vector[1], l->vector[2],
                l->elongation != 0 ? "m" : unit[l->kind],
                l->axes == SCENE_AXES_MEMBER ? "member" : "fixed", l->follower);
        write_extent(to, l);
    }
}

static const char *const component[] = {"ux", "uy", "uz", "rx", "ry", "rz"};

static const char *input_unit(const scene *s, const system_input *in)
{
    if (in->reference)
        return s->load[in->load].feedback.component >= SCENE_RX ? "rad/s" : "m/s";
    if (in->driver != SCENE_NONE)
        return scene_driver_turns(s, in->driver) ? "rad/s^2" : "m/s^2";
    return in->load != SCENE_NONE ? "1" : in->component >= SCENE_RX ? "N m" : "N";
}

static const char *output_unit(const scene_response *as)
{
    static const char *const unit[2][4] = {{"m", "m/s", "m/s^2", "N"},
                                           {"rad", "rad/s", "rad/s^2", "N m"}};
    return unit[as->component >= SCENE_RX][as->of];
}

/* Writes a row for each input. Its kind is "force", "moment", "load", "acceleration" (of a motion)
 * or "reference rate" (of a load). */
static void write_inputs(FILE *to, const void *what)
{
    const contents *c = what;
    fprintf(to, "column,kind,node,component,motion,load,unit\n");
    for (int i = 0; i < c->of->inputs; i++) {
        const system_input *in = &c->of->input[i];
        fprintf(to, "%d,%s,", i + 1,
                in->reference               ? "reference rate"
                : in->load != SCENE_NONE    ? "load"
                : in->driver != SCENE_NONE  ? "acceleration"
                : in->component >= SCENE_RX ? "moment"
                                            : "force");
        name_cell(to, c->scene, SCENE_NODES, in->node);
        fprintf(to, "%s,", in->node != SCENE_NONE ? component[in->component] : "");
        name_cell(to, c->scene, SCENE_DRIVERS, in->driver);
        name_cell(to, c->scene, SCENE_LOADS, in->load);
        fprintf(to, "%s\n", input_unit(c->scene, in));
    }
}

static void write_outputs(FILE *to, const void *what)
{
    static const char *const of[] = {"displacement", "velocity", "acceleration", "reaction"};
    const contents *c = what;
    fprintf(to, "row,quantity,of,node,component,from,unit\n");
    for (int i = 0; i < c->of->outputs; i++) {
        const scene_response *as = &c->of->output[i].as;
        fprintf(to, "%d,", i + 1);
        csv_record_text(to, c->scene->quantity[c->of->output[i].quantity].name);
        fprintf(to, ",%s,", of[as->of]);
        name_cell(to, c->scene, SCENE_NODES, as->node);
        fprintf(to, "%s,", component[as->component]);
        name_cell(to, c->scene, SCENE_NODES, as->from);
        fprintf(to, "%s\n", output_unit(as));
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

static status add_matrix(const output_folder *folder, const char *state, const char *letter,
                         const triplets *t, const char *comment, fault *f)
{
    char file[3 * NAME];
    const titled what = {t, comment};
    if (t->rows == 0 || t->columns == 0)
        return STATUS_OK;
    snprintf(file, sizeof file, "%s/%s.mtx", state, letter);
    return output_folder_file(folder, file, write_matrix, &what, f);
}

static void write_unit(FILE *to, const char *unit)
{
    fprintf(to, strpbrk(unit, " /") != NULL ? "(%s)" : "%s", unit);
}

static void write_ratio_unit(FILE *to, const contents *c, int y, int u)
{
    const char *above = output_unit(&c->of->output[y].as),
               *below = input_unit(c->scene, &c->of->input[u]);
    if (strcmp(below, "1") == 0) {
        fprintf(to, "%s\n", above);
        return;
    }
    write_unit(to, above);
    fputc('/', to);
    write_unit(to, below);
    fputc('\n', to);
}

static void write_errors(FILE *to, const void *what)
{
    const contents *c = what;
    const reduced_model *m = c->reduced;
    fprintf(to, "kind,mode,output,input,whole,reduced,error,at,unit,difference,difference_unit\n");
    for (int i = 0; i < m->modes; i++)
        fprintf(to, "natural frequency,%d,,,%.17g,%.17g,%.3g,,Hz,%.3g,Hz\n", i + 1, m->whole[i],
                m->reduced[i], m->reduced[i] / m->whole[i] - 1, m->reduced[i] - m->whole[i]);
    for (int i = 0; m->apart != NULL && i < c->of->outputs * c->of->inputs; i++) {
        const int y = i / c->of->inputs, u = i % c->of->inputs;
        fprintf(to, "transfer function,,%d,%d,,,", y + 1, u + 1);
        if (isnan(m->apart[i]))
            fputs("nan", to);
        else
            fprintf(to, "%.3g", m->apart[i]);
        fprintf(to, ",%.17g,Hz,%.3g,", m->at[i], m->difference[i]);
        write_ratio_unit(to, c, y, u);
    }
}

static void titled_state(const contents *c, const char *name, int closed, char out[TITLE])
{
    snprintf(out, TITLE, "%.120s%s, %.90s", c->title,
             !scene_has_feedback(c->scene) ? ""
             : closed                      ? ", feedback loops closed"
                                           : ", feedback loops open",
             name);
}

static status add_model(const output_folder *folder, const char *state, const linear_model *m,
                        const triplets *T, const contents *c, fault *f)
{
    char name[2 * NAME], comment[TITLE + 100], title[TITLE];
    const struct {
        const char *letter;
        const triplets *matrix;
    } second[] = {{"K", &m->K},    {"C", &m->C},
                  {"M", &m->M},    {"B", &m->B},
                  {"L", &m->L[0]}, {"L_rate", &m->L[1]},
                  {"D", &m->D},    {"L_acceleration", &m->L[2]}},
      first[] = {{"A", &m->state.A}, {"B", &m->state.B}, {"C", &m->state.C}, {"D", &m->state.D}};
    if (m->state.A.rows == 0)
        return STATUS_OK;
    snprintf(name, sizeof name, "%s/%s", state, T == NULL ? "second_order" : "reduced");
    titled_state(c, name, 0, title);
    snprintf(comment, sizeof comment, "%s; u: inputs.csv, y: outputs.csv; SI", title);
    TRY(output_folder_below(folder, name, f));
    for (size_t i = 0; i < sizeof second / sizeof *second; i++)
        TRY(add_matrix(folder, name, second[i].letter, second[i].matrix, comment, f));
    if (T != NULL)
        TRY(add_matrix(folder, name, "T", T, comment, f));
    snprintf(name, sizeof name, "%s%s/state_space", state, T == NULL ? "" : "/reduced");
    titled_state(c, name, m->loops > 0, title);
    snprintf(comment, sizeof comment,
             "%s; u: inputs.csv, y: outputs.csv; coordinates without mass and damping "
             "eliminated: %d; SI",
             title, m->eliminated);
    TRY(output_folder_below(folder, name, f));
    for (size_t i = 0; i < sizeof first / sizeof *first; i++)
        TRY(add_matrix(folder, name, first[i].letter, first[i].matrix, comment, f));
    return STATUS_OK;
}

static status add_state(const output_folder *folder, const contents *c, const state_matrices *s,
                        fault *f)
{
    char name[NAME], comment[TITLE + 100], title[TITLE];
    name_state(c, s, name);
    titled_state(c, name, 0, title);
    snprintf(comment, sizeof comment, "%s; rows: dofs.csv, columns of B: loads.csv; SI", title);
    TRY(output_folder_below(folder, name, f));
    TRY(add_matrix(folder, name, "K", &s->K, comment, f));
    TRY(add_matrix(folder, name, "M", &s->M, comment, f));
    TRY(add_matrix(folder, name, "G", &s->G, comment, f));
    TRY(add_matrix(folder, name, "C", &s->C, comment, f));
    TRY(add_matrix(folder, name, "M_inside", &s->inside, comment, f));
    TRY(add_matrix(folder, name, "B", &s->B, comment, f));
    TRY(add_model(folder, name, &s->model, NULL, c, f));
    if (s->reduced.T.rows == 0)
        return STATUS_OK;
    const contents errors = {.of = c->of, .scene = c->scene, .reduced = &s->reduced};
    char file[2 * NAME];
    TRY(add_model(folder, name, &s->reduced.of, &s->reduced.T, c, f));
    snprintf(file, sizeof file, "%s/reduced/errors.csv", name);
    return output_folder_file(folder, file, write_errors, &errors, f);
}

static status fill(const output_folder *folder, const contents *c, fault *f)
{
    TRY(output_folder_file(folder, "dofs.csv", write_rows, c, f));
    TRY(output_folder_file(folder, "loads.csv", write_loads, c, f));
    TRY(output_folder_file(folder, "states.csv", write_states, c, f));
    if (c->of->input != NULL) {
        TRY(output_folder_file(folder, "inputs.csv", write_inputs, c, f));
        TRY(output_folder_file(folder, "outputs.csv", write_outputs, c, f));
    }
    for (int i = 0; i < c->of->states; i++)
        TRY(add_state(folder, c, &c->of->state[i], f));
    return STATUS_OK;
}

status system_folder_write(const char *path, const char *title, const scene *s,
                           const system_matrices *of, fault *f)
{
    output_folder folder;
    const contents c = {title, s, of, NULL};
    TRY(output_folder_open(path, &folder, f));
    return output_folder_finish(&folder, fill(&folder, &c, f), f);
}
