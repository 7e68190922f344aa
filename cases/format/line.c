#include "cases/format/format_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"

static void meaning_state(FILE *to, const scene *s, const scene_quantity *q);

static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

void line_skip_mark(FILE *from)
{
    static const int mark[] = {0xef, 0xbb, 0xbf};
    for (int i = 0; i < 3; i++) {
        const int got = getc(from);
        if (got == mark[i])
            continue;
        if (got != EOF)
            ungetc(got, from);
        while (i > 0)
            ungetc(mark[--i], from);
        return;
    }
}

FILE *line_open(const char *path)
{
    FILE *from = fopen(path, "r");
    if (from != NULL)
        line_skip_mark(from);
    return from;
}

char *line_trim(char *line)
{
    size_t length = strlen(line);
    while (length > 0 && is_blank(line[length - 1]))
        line[--length] = '\0';
    while (is_blank(*line))
        line++;
    return line;
}

/* Returns the number of bytes that follow the first byte of a UTF-8 character. */
static int following(unsigned char first)
{
    if (first < 0xc2 || first >= 0xf5)
        return 0;
    if (first < 0xe0)
        return 1;
    return first < 0xf0 ? 2 : 3;
}

/* Returns the number of bytes of the character that starts at `at`, or 0 if the character is
 * invalid or a control character other than a tab. */
static int character_length(const unsigned char *at)
{
    if (at[0] < 0x80)
        return at[0] >= 0x20 && at[0] != 0x7f ? 1 : at[0] == '\t';
    const int more = following(at[0]);
    for (int i = 1; i <= more; i++)
        if ((at[i] & 0xc0) != 0x80)
            return 0;
    const int long_form = (at[0] == 0xe0 && at[1] < 0xa0) || (at[0] == 0xf0 && at[1] < 0x90);
    const int beyond = (at[0] == 0xed && at[1] > 0x9f) || (at[0] == 0xf4 && at[1] > 0x8f);
    return more == 0 || long_form || beyond ? 0 : more + 1;
}

char *line_text(char *line, size_t length)
{
    if (strlen(line) != length)
        return NULL;
    char *text = line_trim(line);
    const unsigned char *at = (const unsigned char *)text;
    while (*at != '\0') {
        const int bytes = character_length(at);
        if (bytes == 0)
            return NULL;
        at += bytes;
    }
    return text;
}

/* Terminates the field that starts at `at`. Returns the position of the next field, or NULL. */
static char *end_field(char *at)
{
    char *end = at;
    for (int quoted = 0; *end != '\0' && (quoted || *end != ','); end++)
        quoted ^= *end == '"';
    if (*end == '\0')
        return NULL;
    *end = '\0';
    return end + 1;
}

static char *unquoted(char *field)
{
    field = line_trim(field);
    const size_t length = strlen(field);
    if (length < 2 || field[0] != '"' || field[length - 1] != '"')
        return field;
    char *to = field;
    for (const char *from = field + 1; from < field + length - 1; from++) {
        from += from[0] == '"' && from[1] == '"' && from + 1 < field + length - 1;
        *to++ = *from;
    }
    *to = '\0';
    return field;
}

int line_split(char *line, char *field[], int most)
{
    int count = 0;
    while (line != NULL && count <= most) {
        char *next = end_field(line);
        if (count < most)
            field[count] = unquoted(line);
        count++;
        line = next;
    }
    return count;
}

int line_words(char *line, char *word[], int most)
{
    int count = 0;
    for (line += strspn(line, " \t\r\n,"); *line != '\0' && count <= most;) {
        if (count < most)
            word[count] = line;
        count++;
        line += strcspn(line, " \t\r\n,");
        if (*line != '\0')
            *line++ = '\0';
        line += strspn(line, " \t\r\n,");
    }
    return count;
}

int line_number(const char *text, double *value)
{
    char copy[64], *end;
    const size_t length = strlen(text);
    if (length == 0 || length >= sizeof copy || strspn(text, "+-.0123456789eEdD") != length)
        return 0;
    for (size_t i = 0; i <= length; i++)
        copy[i] = (char)(text[i] == 'D' || text[i] == 'd' ? 'e' : text[i]);
    *value = strtod(copy, &end);
    return *end == '\0' && isfinite(*value);
}

static void put_sentence(const scene *s, const scene_quantity *q, char *text, size_t size)
{
    FILE *to = fmemopen(text, size, "w");
    text[0] = '\0';
    if (to == NULL)
        return;
    const quantity_type *type = quantity_type_of(q);
    type->meaning(to, s, q);
    if (!type->names_analysis)
        meaning_state(to, s, q);
    if (q->factor == -1)
        fputs(", with the opposite sign", to);
    else if (q->factor != 1)
        fprintf(to, ", times %.10g", q->factor);
    if (q->offset != 0)
        fprintf(to, ", plus %.10g", q->offset);
    fclose(to);
    text[size - 1] = '\0';
}

static int has_twin(const scene *s, const scene_quantity *q, const char *text)
{
    char other[MEANING_ROOM];
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *r = &s->quantity[i];
        if (r->analysis == q->analysis || r->what.kind != q->what.kind)
            continue;
        put_sentence(s, r, other, sizeof other);
        if (strcmp(other, text) == 0)
            return 1;
    }
    return 0;
}

void meaning_of_quantity(const scene *s, int quantity, char *text, size_t size)
{
    const scene_quantity *q = &s->quantity[quantity];
    char sentence[MEANING_ROOM];
    put_sentence(s, q, sentence, sizeof sentence);
    if (has_twin(s, q, sentence))
        snprintf(text, size, "%s (%s)", sentence, scene_name(s, SCENE_ANALYSES, q->analysis).text);
    else
        snprintf(text, size, "%s", sentence);
}

/* Returns the angular velocity [rad/s] at path parameter 1. */
static double speed(const scene_analysis *a)
{
    const double *omega = scene_walk_of(a)->frame.omega;
    return sqrt(omega[0] * omega[0] + omega[1] * omega[1] + omega[2] * omega[2]);
}

static const char *path_name(const scene_analysis *a)
{
    if (a->kind == SCENE_MOTION)
        return "motion";
    if (a->kind == SCENE_HARMONIC)
        return "frequencies";
    return a->kind == SCENE_CONTINUATION ? "path of the load factor" : "static path";
}

static const scene_analysis *path_of(const scene *s, const scene_analysis *a)
{
    const scene_analysis *walked =
        scene_path_of(a) == NULL && a->follows != SCENE_NONE ? &s->analysis[a->follows] : a;
    return scene_path_of(walked) != NULL ? walked : NULL;
}

static void at_station(FILE *to, const scene *s, const scene_quantity *q, const scene_analysis *a)
{
    const scene_path *path = scene_path_of(a);
    const double last = path->value[path->stations - 1],
                 at = q->reduction == SCENE_AT ? q->at : last;
    if (a->kind == SCENE_ROTATION && speed(a) * last == 0) {
        fputs(", at rest", to);
    } else if (a->kind == SCENE_ROTATION) {
        fprintf(to, ", rotating at %.10g rad/s", speed(a) * at);
    } else if (a->kind == SCENE_CONTINUATION) {
        const scene_control *control = &scene_continuation_of(a)->control;
        fputs(", where the ", to);
        meaning_coordinate(to, s, control->node, control->component);
        fprintf(to, " is %.10g m", at);
    } else if (a->kind == SCENE_MOTION) {
        fprintf(to, ", %.10g s after the start of the motion", at);
    } else if (a->kind == SCENE_HARMONIC) {
        fprintf(to, ", at %.10g Hz", at);
    } else if (q->reduction != SCENE_AT) {
        fputs(", at the end of the static path", to);
    } else {
        fprintf(to, ", at %.10g on the static path (0 to %.10g)", at, last);
    }
}

static void passing(FILE *to, const scene_quantity *q)
{
    static const char *const way[] = {"rises through", "falls through", "passes"};
    const scene_passing *p = &q->passing;
    if (q->reduction == SCENE_MEAN)
        fputs(", mean over time", to);
    else if (q->reduction == SCENE_RMS)
        fputs(", root mean square over time", to);
    else if (q->reduction == SCENE_MAX_TIME || q->reduction == SCENE_MIN_TIME)
        fprintf(to, ", time at which it is %s",
                q->reduction == SCENE_MAX_TIME ? "largest" : "least");
    else if (q->reduction == SCENE_CROSSING)
        fprintf(to, ", time at which it %s %.10g (crossing %d)", way[p->direction], p->level,
                p->order + 1);
    else
        fprintf(to, ", %s with which it %s %.10g",
                q->reduction == SCENE_PERIOD ? "period" : "frequency", way[p->direction], p->level);
    if (p->from > 0 || p->until > 0)
        fprintf(to, ", from %.10g s on", p->from);
    if (p->until > 0)
        fprintf(to, " until %.10g s", p->until);
}

static void along_path(FILE *to, const scene *s, const scene_quantity *q, const scene_analysis *a)
{
    const char *name = a->kind == SCENE_ROTATION ? "speeds of rotation" : path_name(a);
    switch (q->reduction) {
    case SCENE_LAST:
    case SCENE_AT:
        at_station(to, s, q, a);
        break;
    case SCENE_MAX:
        fprintf(to, ", largest value over the %s", name);
        break;
    case SCENE_MIN:
        fprintf(to, ", smallest value over the %s", name);
        break;
    case SCENE_CURVE:
        if (q->transform == SCENE_HISTORY)
            fprintf(to, ", as a curve over %s [%s] (%s)", q->x.name, q->x.unit, name);
        else
            fprintf(to, ", %s of its values at the stations%s, over %s [%s]",
                    q->transform == SCENE_PSD ? "power spectral density" : "spectrum of amplitudes",
                    q->passing.taper == SCENE_TAPER_HANN ? " with Hann's window" : "", q->x.name,
                    q->x.unit);
        break;
    case SCENE_MAX_TIME:
    case SCENE_MIN_TIME:
    case SCENE_CROSSING:
    case SCENE_PERIOD:
    case SCENE_PER_SECOND:
    case SCENE_MEAN:
    case SCENE_RMS:
    case SCENE_REDUCTIONS:
        passing(to, q);
        break;
    }
}

static void acting(FILE *to, const scene *s, const scene_quantity *q)
{
    static const char *const of[] = {"", "largest of", "least of",
                                     "value with the largest magnitude among"};
    const int own = scene_acting_of(s, q->analysis);
    if (q->envelope == SCENE_ENVELOPE_NONE) {
        const int number = own != 0 ? own : scene_acting_in(s, q, 0);
        if (number != 0)
            fprintf(to, ", %s", scene_acting_called(s, number).text);
        return;
    }
    fprintf(to, ", %s ", of[q->envelope]);
    if (q->overs == 0)
        fputs(s->combinations > 0 ? "all combinations" : "all load cases", to);
    for (int i = 0; i < q->overs; i++)
        fprintf(to, "%s%s",
                i > 0          ? ", "
                : q->overs > 1 ? "combinations "
                               : "combination ",
                scene_name(s, SCENE_COMBINATIONS, q->over[i]).text);
}

static void meaning_state(FILE *to, const scene *s, const scene_quantity *q)
{
    const scene_analysis *a = &s->analysis[q->analysis];
    const double instant = scene_instant_of(s, q->analysis);
    const scene_analysis *path = a->kind == SCENE_MODAL && !isnan(instant) ? NULL : path_of(s, a);
    if (!isnan(instant))
        fprintf(to, ", about the state at %.10g s of the motion", instant);
    if (path != NULL)
        along_path(to, s, q, path);
    else if (a->kind == SCENE_LINEAR)
        fputs(", small displacements", to);
    else if (a->follows != SCENE_NONE && isnan(instant))
        fputs(", for small displacements about the loaded state", to);
    else if (isnan(instant))
        fputs(", of the undeformed structure", to);
    if (path != NULL && path->kind == SCENE_STATIC && scene_rotates(path))
        fprintf(to, ", while the axes rotate at %.10g rad/s", speed(path));
    if (a->kind == SCENE_COMPLIANCE && scene_compliance_of(a)->moments != SCENE_MOMENTS_SPATIAL)
        fprintf(to, ", moments %s", scene_moments_name(scene_compliance_of(a)->moments));
    acting(to, s, q);
}
