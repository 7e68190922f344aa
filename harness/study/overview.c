#include "harness/study/study_impl.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* if there are more columns, all options of a formulation share a column */
enum { MOST_COLUMNS = 10 };
/* if there are more cases, cases that pass share lines */
enum { MOST_ROWS = 24 };

static const overview_mark marks[VERDICT_KINDS] = {
    [VERDICT_PASS] = OVERVIEW_PASS,
    [VERDICT_BIASED] = OVERVIEW_BIASED,
    [VERDICT_WRONG_LIMIT] = OVERVIEW_WRONG,
    [VERDICT_BIASED_AS_PREDICTED] = OVERVIEW_BIASED,
    [VERDICT_WRONG_AS_PREDICTED] = OVERVIEW_WRONG,
    [VERDICT_LOW_ORDER] = OVERVIEW_LOW_ORDER,
    [VERDICT_UNDECIDED] = OVERVIEW_UNDECIDED,
    [VERDICT_DIVERGED] = OVERVIEW_NO_VALUE,
    [VERDICT_REFUSED] = OVERVIEW_NO_VALUE,
    [VERDICT_SKIP] = OVERVIEW_NOTHING,
    [VERDICT_NO_TRUTH] = OVERVIEW_NOTHING,
    [VERDICT_OTHER_MODEL] = OVERVIEW_OTHER_MODEL,
};

static const struct {
    const char *ascii, *utf8, *words;
} signs[OVERVIEW_MARKS] = {
    [OVERVIEW_NOTHING] = {".", "·", "no verdict: not supported, or no reference value"},
    [OVERVIEW_OTHER_MODEL] = {"m", "○", "another model: shown without a verdict"},
    [OVERVIEW_PASS] = {"ok", "✓", "all pass"},
    [OVERVIEW_LOW_ORDER] = {"v", "↓", "right limit, low order of convergence"},
    [OVERVIEW_UNDECIDED] = {"?", "?", "uncertainty of the limit too large"},
    [OVERVIEW_BIASED] = {"~", "≈", "biased limit, within the tolerance"},
    [OVERVIEW_WRONG] = {"#", "≠", "limit outside the tolerance"},
    [OVERVIEW_NO_VALUE] = {"x", "×", "no value on the finest mesh"},
    [OVERVIEW_FLAW] = {"c", "c",
                       "differs from the stored value, or has an inconsistent run record"},
};

const char *overview_words(overview_mark mark)
{
    return signs[mark].words;
}

void overview_text(const overview_cell *c, int utf8, char text[OVERVIEW_TEXT])
{
    const char *sign = utf8 ? signs[c->mark].utf8 : signs[c->mark].ascii;
    const char *first = c->unexpected ? "!" : "";
    if (c->mark <= OVERVIEW_PASS)
        snprintf(text, OVERVIEW_TEXT, "%s%s", first, sign);
    else
        snprintf(text, OVERVIEW_TEXT, "%s%s%d", first, sign, c->count);
}

static const char *name_of(const series *one, int joined)
{
    return joined && one->imported == NULL ? one->formulation.type->name : one->formulation.key;
}

static int column_of(const overview *o, const char *name)
{
    int i = 0;
    while (i < o->columns && strcmp(o->column[i], name) != 0)
        i++;
    return i;
}

static int row_of(const overview *o, const case_type *type)
{
    int i = 0;
    while (i < o->rows && o->row[i] != type)
        i++;
    return i;
}

static int is_new(const sweep *s, const series *one)
{
    return one->imported == NULL && !sweep_gates(s, one);
}

static void add_columns(const sweep *s, overview *out, int of_new)
{
    for (int i = 0; i < s->seriess; i++) {
        const char *name = name_of(&s->series[i], out->joined);
        if (is_new(s, &s->series[i]) == of_new && column_of(out, name) == out->columns)
            out->column[out->columns++] = name;
    }
}

static void find_columns(const sweep *s, overview *out, int joined)
{
    out->joined = joined;
    out->columns = 0;
    add_columns(s, out, 0);
    out->accepted = out->columns;
    add_columns(s, out, 1);
}

static void find_rows(const sweep *s, overview *out)
{
    for (int i = 0; i < s->seriess; i++) {
        const case_type *type = s->point[s->series[i].point].type;
        if (row_of(out, type) == out->rows)
            out->row[out->rows++] = type;
    }
}

static overview_cell *cell_of(const sweep *s, const overview *o, int series_index)
{
    const series *one = &s->series[series_index];
    const int row = row_of(o, s->point[one->point].type);
    return &o->cell[row * o->columns + column_of(o, name_of(one, o->joined))];
}

static void add(overview_cell *to, overview_mark mark, int unexpected)
{
    const int rank = OVERVIEW_MARKS * unexpected + (int)mark;
    const int before = OVERVIEW_MARKS * to->unexpected + (int)to->mark;
    if (rank > before)
        *to = (overview_cell){.mark = mark, .unexpected = unexpected, .count = 1};
    else if (rank == before)
        to->count++;
}

static void fill(const sweep *s, const evaluation *j, overview *out)
{
    for (int i = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        add(cell_of(s, out, v->series), marks[v->kind], !v->matches);
    }
    for (int i = 0; i < j->agreements; i++)
        if (!j->agreement[i].good)
            add(cell_of(s, out, j->agreement[i].series), OVERVIEW_FLAW, 1);
    for (int i = 0; i < j->flaws; i++)
        add(cell_of(s, out, j->flaw[i].series), OVERVIEW_FLAW, 1);
}

status overview_make(const sweep *s, const evaluation *j, overview *out, fault *f)
{
    const size_t most = (size_t)s->seriess + 1;
    *out = (overview){.row = calloc(most, sizeof(void *)),
                      .column = calloc(most, sizeof *out->column)};
    if (out->row == NULL || out->column == NULL)
        return fault_memory(f, "the overview");
    find_rows(s, out);
    find_columns(s, out, 0);
    if (out->columns > MOST_COLUMNS)
        find_columns(s, out, 1);
    out->cell = calloc((size_t)(out->rows * out->columns) + 1, sizeof *out->cell);
    if (out->cell == NULL)
        return fault_memory(f, "the overview");
    fill(s, j, out);
    return STATUS_OK;
}

void overview_free(overview *o)
{
    free(o->row);
    free(o->column);
    free(o->cell);
    *o = (overview){0};
}

const overview_cell *overview_at(const overview *o, int row, int column)
{
    return &o->cell[row * o->columns + column];
}

static int overview_passes(const overview *o, int row)
{
    int passes = 1;
    for (int i = 0; i < o->columns; i++) {
        const overview_cell *c = overview_at(o, row, i);
        passes &= c->mark <= OVERVIEW_PASS && !c->unexpected;
    }
    return passes;
}

int overview_evaluated(const overview *o, int row)
{
    int evaluated = 0;
    for (int i = 0; i < o->columns; i++)
        evaluated |= overview_at(o, row, i)->mark >= OVERVIEW_PASS;
    return evaluated;
}

int overview_shown(const overview *o, int row)
{
    return o->rows <= MOST_ROWS || !overview_passes(o, row);
}

static const char seal[] = "beamwork-seal";

static void write_line(size_t size, uint32_t sum, char out[CHECKSUM_LENGTH + 1])
{
    snprintf(out, CHECKSUM_LENGTH + 1, "%s %016zx %08x\n", seal, size, (unsigned)sum);
}

void checksum_write(const void *data, size_t size, char out[CHECKSUM_LENGTH + 1])
{
    write_line(size, crc_add(0, data, size), out);
}

status checksum_of_file(const char *path, char out[CHECKSUM_LENGTH + 1], fault *f)
{
    enum { PIECE = 1 << 16 };
    unsigned char buffer[PIECE];
    size_t size = 0, got;
    uint32_t sum = 0;
    FILE *from = fopen(path, "rb");
    if (from == NULL)
        return fault_unreadable(f, path, errno);
    while ((got = fread(buffer, 1, PIECE, from)) > 0) {
        sum = crc_add(sum, buffer, got);
        size += got;
    }
    const int bad = ferror(from);
    fclose(from);
    write_line(size, sum, out);
    return bad ? fault_unreadable(f, path, EIO) : STATUS_OK;
}

status checksum_read(const char *path, char out[CHECKSUM_LENGTH + 1], fault *f)
{
    FILE *from = fopen(path, "rb");
    const int good = from != NULL && fseek(from, -CHECKSUM_LENGTH, SEEK_END) == 0 &&
                     fread(out, 1, CHECKSUM_LENGTH, from) == CHECKSUM_LENGTH;
    if (from != NULL)
        fclose(from);
    out[good ? CHECKSUM_LENGTH : 0] = '\0';
    return good ? STATUS_OK : fault_unreadable(f, path, errno);
}

/* Computes the checksum of all bytes except the last CHECKSUM_LENGTH bytes, which are copied to
 * `tail`. Returns the length of the file without `tail`; -1: the file is too short. */
static long read_body(FILE *from, uint32_t *sum, char tail[CHECKSUM_LENGTH + 1])
{
    enum { PIECE = 1 << 18 };
    static const size_t held = CHECKSUM_LENGTH;
    unsigned char buffer[CHECKSUM_LENGTH + PIECE];
    size_t have = 0, got;
    long body = 0;
    *sum = 0;
    while ((got = fread(buffer + have, 1, PIECE, from)) > 0) {
        have += got;
        if (have <= held)
            continue;
        *sum = crc_add(*sum, buffer, have - held);
        body += (long)(have - held);
        memmove(buffer, buffer + have - held, held);
        have = held;
    }
    if (have < held || ferror(from))
        return -1;
    memcpy(tail, buffer, held);
    tail[held] = '\0';
    return body;
}

status checksum_check(const char *path, fault *f)
{
    char tail[CHECKSUM_LENGTH + 1], right[CHECKSUM_LENGTH + 1];
    uint32_t sum;
    FILE *from = fopen(path, "rb");
    if (from == NULL)
        return fault_unreadable(f, path, errno);
    const long body = read_body(from, &sum, tail);
    fclose(from);
    write_line(body >= 0 ? (size_t)body : 0, sum, right);
    return body >= 0 && strcmp(tail, right) == 0
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "%.120s %s", path,
                           body >= 0 && strncmp(tail, seal, strlen(seal)) == 0
                               ? "is damaged, or was altered after beamwork wrote it; copy it "
                                 "again, or remove it and repeat the command that wrote it"
                               : "was not written by beamwork, or its end is missing; give a "
                                 "complete file that beamwork wrote");
}
