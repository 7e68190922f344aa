#include "cases/format/format_impl.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void scene_file_truths_check(const scene_file *file, const scene *s, const double value[],
                                    mistakes *m);

enum { VERSION = 1 };

static void check_version(const scene_file *file, mistakes *m)
{
    const document_node *n = document_find(file->root, "beamwork");
    if (strcmp(n->text, "1") != 0)
        document_mistake(
            m, n, 0,
            "format version '%.20s' is unknown; write 'beamwork: %d', or use a newer program",
            n->text, VERSION);
    else if (strcmp(file->root->key[0]->text, "beamwork") != 0)
        document_mistake(m, file->root, 0,
                         "'beamwork: 1' must be the first key; move it to the top");
}

/* Returns the file name up to its first point, with '_' instead of each character that a name
 * cannot contain. A name that would be empty or start with a digit starts with "scene_". */
static const char *name_of_file(scene_file *file)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_"
                                  "0123456789";
    char name[SCENE_NAME];
    const char *slash = strrchr(file->path, '/');
    const char *at = slash != NULL ? slash + 1 : file->path;
    size_t count = 0;
    if (*at == '\0' || *at == '.' || (*at >= '0' && *at <= '9'))
        count = (size_t)snprintf(name, sizeof name, "scene_");
    for (; *at != '\0' && *at != '.' && count < SCENE_NAME - 1; at++)
        if (((unsigned char)*at & 0xc0) != 0x80) /* not a continuation byte */
            name[count++] = strspn(at, letters) > 0 ? *at : '_';
    return arena_copy(&file->arena, name, count);
}

static void read_name(scene_file *file, mistakes *m)
{
    const document_node *n = document_find(file->root, "name");
    const char *text = n != NULL ? n->text : name_of_file(file);
    if (text == NULL)
        return;
    file->type.name = text;
    const size_t length = strlen(text);
    if (length == 0 || length >= SCENE_NAME || expression_name_length(text) != length)
        document_mistake(
            m, n != NULL ? n : file->root, 0,
            "name '%.60s': use at most %d letters, digits and _, beginning with a letter", text,
            SCENE_NAME - 1);
}

static const char *line_of(const scene_file *file, const char *key)
{
    const document_node *n = document_find(file->root, key);
    return n != NULL ? n->text : "";
}

static void build_at(const scene_file *file, const double value[], scene *s, mistakes *m)
{
    arena a = {0};
    build_scene(file->root, parameter_table_names(file->parameter, value, &a), &a, m, s);
    arena_free(&a);
}

static status build_from(const void *context, const double value[], scene *s, fault *f)
{
    const scene_file *file = context;
    mistakes m = {.file = file->path};
    build_at(file, value, s, &m);
    return mistakes_status(&m, f);
}

/* Reads the tree and the tables in other files, checks the keys, and reads the parameters. `folder`
 * is the path of a file in the folder to which table files are relative, or NULL. */
static void read_form(scene_file *file, const char *bytes, size_t size, const char *folder,
                      mistakes *m)
{
    document_node *root = document_read(bytes, size, &file->arena, m);
    file->root = root;
    if (root != NULL)
        table_files_read(root, folder, &file->arena, m);
    if (root == NULL || m->count > 0 || !keys_check(root, m))
        return;
    check_version(file, m);
    read_name(file, m);
    file->type.summary = line_of(file, "summary");
    file->type.source = line_of(file, "source");
    parameter_table_read(file, m);
}

static void check_at(const scene_file *file, const double value[], mistakes *m)
{
    scene s;
    scene_init(&s, file->type.name);
    build_at(file, value, &s, m);
    if (m->count == 0)
        scene_file_truths_check(file, &s, value, m);
    scene_free(&s);
}

status scene_file_check(const scene_file *file, const double value[], mistakes *m, fault *f)
{
    memset(m, 0, sizeof *m);
    m->file = file->path;
    check_at(file, value, m);
    return mistakes_status(m, f);
}

/* `folder` is as in read_form. If `built` is 1, the scene is also built at its defaults. */
static status read_from(const char *bytes, size_t size, const char *path, const char *folder,
                        int built, scene_file **out, mistakes *m, fault *f)
{
    memset(m, 0, sizeof *m);
    m->file = path;
    *out = NULL;
    scene_file *file = calloc(1, sizeof *file);
    if (file == NULL)
        return fault_memory(f, "%.200s", path);
    file->path = path;
    file->type.build_from = build_from;
    file->type.context = file;
    file->type.file = path;
    read_form(file, bytes, size, folder, m);
    if (built && m->count == 0 && !m->out_of_memory && !file->arena.failed) {
        double value[CASE_MAX_PARAMETERS] = {0};
        parameter_defaults(file->type.parameters, value);
        check_at(file, value, m);
    }
    m->out_of_memory |= file->arena.failed;
    const status outcome = mistakes_status(m, f);
    if (outcome == STATUS_OK)
        *out = file;
    else
        scene_file_free(file);
    return outcome;
}

status scene_file_read_bytes(const char *bytes, size_t size, const char *path, scene_file **out,
                             mistakes *m, fault *f)
{
    return read_from(bytes, size, path, NULL, 1, out, m, f);
}

static status read_bytes(const char *path, char *bytes, size_t room, size_t *size, fault *f)
{
    FILE *from = fopen(path, "rb");
    if (from == NULL)
        return fault_unreadable(f, path, errno);
    *size = fread(bytes, 1, room, from);
    const int failed = ferror(from);
    fclose(from);
    return failed ? fault_unreadable(f, path, EIO) : STATUS_OK;
}

static status read_file(const char *path, char *bytes, size_t room, int built, scene_file **out,
                        mistakes *m, fault *f)
{
    size_t size = 0;
    TRY(read_bytes(path, bytes, room, &size, f));
    return read_from(bytes, size, path, path, built, out, m, f);
}

static status read_path(const char *path, int built, scene_file **out, mistakes *m, fault *f)
{
    const size_t room = DOCUMENT_BYTES + 1;
    char *bytes = malloc(room);
    *out = NULL;
    memset(m, 0, sizeof *m);
    m->file = path;
    if (bytes == NULL)
        return fault_memory(f, "%.200s", path);
    const status outcome = read_file(path, bytes, room, built, out, m, f);
    free(bytes);
    return outcome;
}

status scene_file_read(const char *path, scene_file **out, mistakes *m, fault *f)
{
    return read_path(path, 1, out, m, f);
}

status scene_file_read_form(const char *path, scene_file **out, mistakes *m, fault *f)
{
    return read_path(path, 0, out, m, f);
}

void scene_file_free(scene_file *file)
{
    if (file == NULL)
        return;
    arena_free(&file->arena);
    free(file);
}

int scene_file_states(const scene_file *file, const char *key)
{
    return document_find(file->root, key) != NULL;
}

const case_type *scene_file_case(const scene_file *file)
{
    return &file->type;
}

const document_node *scene_file_document(const scene_file *file)
{
    return file->root;
}

const char *scene_file_path(const case_type *type)
{
    return type->build_from == build_from ? ((const scene_file *)type->context)->path : NULL;
}

typedef struct file_truth {
    int holds; /* 1 if the reference value applies at the current parameter point */
    scene_truth truth_row;
} file_truth;

static const scene_quantity *quantity_of(const scene *s, const char *name)
{
    for (int i = 0; i < s->quantities; i++)
        if (strcmp(s->quantity[i].name, name) == 0)
            return &s->quantity[i];
    return NULL;
}

/* Returns the index of a parameter in the conditions of a reference value, or -1 after an error.
 * Sets *value to the value in the condition. */
static int named_value(const scene_file *file, const fields *f, const document_node *those, int i,
                       double *value)
{
    const int index = parameter_index(file->type.parameters, those->key[i]->text);
    mistakes *m = f->b->mistakes;
    if (index < 0) {
        document_mistake(
            m, those->key[i], 0,
            "the scene has no parameter '%.40s'; correct the name, or add the parameter",
            those->key[i]->text);
        return -1;
    }
    const parameter_type *p = &file->parameter[index];
    if (p->choices != NULL)
        *value = fields_word_of(f, those->item[i], p->name, p->choices, 0);
    else if (expression_number(those->item[i], NULL, m, value) &&
             !(*value >= p->min && *value <= p->max))
        mistake_parameter(m, those->item[i], p, *value);
    return index;
}

/* Sets the parameters in `point` to the values in the conditions of the reference value. Returns 1
 * if this changes nothing. */
static int visit_point(const scene_file *file, const fields *f, double point[])
{
    const document_node *those = document_find(f->map, "parameters");
    int same = 1;
    if (those != NULL)
        for (int i = 0; i < those->count; i++) {
            double value = 0;
            const int index = named_value(file, f, those, i, &value);
            same &= index >= 0 && point[index] == value;
            if (index >= 0)
                point[index] = value;
        }
    return same;
}

static file_truth read_one(const scene_file *file, const fields *f, const scene *s,
                           const double value[])
{
    static const char kinds[] =
        "exact|predicted|independent|agreement|consensus|published|reconstructed|experiment";
    double point[CASE_MAX_PARAMETERS];
    mistakes *m = f->b->mistakes;
    memcpy(point, value, sizeof point);
    const int holds = visit_point(file, f, point);
    scene_truth t = {.parameter = value,
                     .value = fields_number(f, "value", 0),
                     .uncertainty = fields_number(f, "uncertainty", 0),
                     .at = fields_number(f, "at", NAN),
                     .quantity = fields_text(f, "quantity", ""),
                     .unit = "",
                     .kind = fields_text(f, "kind", ""),
                     .formulation = fields_text(f, "formulation", ""),
                     .theory = fields_text(f, "theory", ""),
                     .model = fields_have(f, "model") ? "other" : "same",
                     .convention = fields_text(f, "convention", ""),
                     .source = fields_text(f, "source", "")};
    fields_word(f, "kind", kinds, 0);
    fields_word(f, "theory", SCENE_SHEAR_THEORIES, 0);
    fields_word(f, "model", "plate|solid", 0);
    if (!(t.uncertainty >= 0))
        document_mistake(m, document_find(f->map, "uncertainty"), 0,
                         "uncertainty = %g; give a positive value, or remove the key",
                         t.uncertainty);
    if ((strcmp(t.kind, "predicted") == 0) != (t.formulation[0] != '\0'))
        document_mistake(m, f->place, 0, "the reference value of %.40s, of kind %.40s, %s",
                         t.quantity, t.kind,
                         t.formulation[0] != '\0'
                             ? "has 'formulation', which is only for kind predicted; remove it"
                             : "has no 'formulation'; add it");
    const scene_quantity *q = quantity_of(s, t.quantity);
    if (q == NULL)
        fields_entry(f, "quantity", SCENE_QUANTITIES);
    else
        t.unit = q->unit;
    return (file_truth){holds, t};
}

typedef struct truth_reader {
    builder b;
    unrolled *list;
    int count;
} truth_reader;

static truth_reader open_truths(const scene_file *file, const double value[], arena *a, mistakes *m)
{
    truth_reader r = {.b = {.arena = a, .mistakes = m, .root = file->root}};
    r.b.names = unroll_let(document_find(file->root, "let"),
                           parameter_table_names(file->parameter, value, a), a, m);
    scene of_sections;
    scene_init(&of_sections, "");
    r.b.scene = &of_sections;
    build_sections(&r.b);
    r.b.scene = NULL;
    scene_free(&of_sections);
    r.b.list[SCENE_QUANTITIES].count =
        unroll_entries(document_find(file->root, "quantities"), r.b.names, a, m,
                       &r.b.list[SCENE_QUANTITIES].entry);
    r.count = unroll_entries(document_find(file->root, "truths"), r.b.names, a, m, &r.list);
    return r;
}

static void scene_file_truths_check(const scene_file *file, const scene *s, const double value[],
                                    mistakes *m)
{
    arena a = {0};
    truth_reader r = open_truths(file, value, &a, m);
    for (int i = 0; i < r.count; i++) {
        const fields f = fields_of(&r.b, &r.list[i]);
        read_one(file, &f, s, value);
    }
    m->out_of_memory |= a.failed;
    arena_free(&a);
}

static status give_at(const scene_file *file, const double point[], scene *s, arena *a,
                      scene_truth_taker *take, void *to, fault *f)
{
    mistakes m = {.file = file->path};
    TRY(file->type.build_from(file, point, s, f));
    truth_reader r = open_truths(file, point, a, &m);
    for (int i = 0; i < r.count; i++) {
        const fields those = fields_of(&r.b, &r.list[i]);
        const file_truth one = read_one(file, &those, s, point);
        m.out_of_memory |= a->failed;
        TRY(mistakes_status(&m, f));
        if (one.holds)
            TRY(take(to, &one.truth_row, f));
    }
    m.out_of_memory |= a->failed;
    return mistakes_status(&m, f);
}

status scene_file_truths(const scene_file *file, const double value[], scene_truth_taker *take,
                         void *to, fault *f)
{
    arena a = {0};
    double point[CASE_MAX_PARAMETERS] = {0};
    scene s;
    memcpy(point, value, (size_t)file->parameters * sizeof *point);
    scene_init(&s, file->type.name);
    const status outcome = give_at(file, point, &s, &a, take, to, f);
    scene_free(&s);
    arena_free(&a);
    return outcome;
}

static status give_everywhere(const scene_file *file, arena *a, scene_truth_taker *take, void *to,
                              fault *f)
{
    mistakes m = {.file = file->path};
    double defaults[CASE_MAX_PARAMETERS] = {0};
    parameter_defaults(file->type.parameters, defaults);
    TRY(scene_file_truths(file, defaults, take, to, f));
    const truth_reader r = open_truths(file, defaults, a, &m);
    for (int i = 0; i < r.count; i++) {
        builder b = r.b;
        const fields those = fields_of(&b, &r.list[i]);
        double point[CASE_MAX_PARAMETERS];
        memcpy(point, defaults, sizeof point);
        if (!visit_point(file, &those, point))
            TRY(scene_file_truths(file, point, take, to, f));
    }
    m.out_of_memory |= a->failed;
    return mistakes_status(&m, f);
}

status scene_file_truths_all(const scene_file *file, scene_truth_taker *take, void *to, fault *f)
{
    arena a = {0};
    const status outcome = give_everywhere(file, &a, take, to, f);
    arena_free(&a);
    return outcome;
}
