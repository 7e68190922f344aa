#include "harness/terminal/terminal_impl.h"

#include <langinfo.h>
#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cases/scene/scene.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/records/records.h"

enum { INDENT = 2 };

void table_percent(FILE *to, double error)
{
    char text[ROUNDING_TEXT];
    rounding_percent(error, text);
    fprintf(to, " %11s", text);
}

void table_known(FILE *to, int width, double value, double uncertainty)
{
    char text[ROUNDING_TEXT];
    rounding_known(value, uncertainty, text);
    fprintf(to, "%*s", width, text);
}

void table_digits(FILE *to, int width, double value, int digits)
{
    char text[ROUNDING_TEXT];
    rounding_digits(value, digits, text);
    fprintf(to, "%*s", width, text);
}

void table_value(FILE *to, int width, int digits, char conversion, double value)
{
    if (!isfinite(value))
        fprintf(to, "%*s", width, "-");
    else if (conversion == 'g')
        fprintf(to, "%*.*g", width, digits, value);
    else if (conversion == 'e')
        fprintf(to, "%*.*e", width, digits, value);
    else
        fprintf(to, "%*.*f", width, digits, value);
}

void table_point(FILE *to, const sweep_point *p)
{
    fprintf(to, "%s%s%s", p->type->name, p->text[0] != '\0' ? ": " : "", p->text);
}

/* Returns the physics that the source of a case omits if all physics was requested. */
static unsigned omitted_by_source(const sweep_point *p)
{
    double value[CASE_MAX_PARAMETERS];
    scene s = {0};
    unsigned omitted = 0;
    memcpy(value, p->parameter, sizeof value);
    value[parameters_count(p->type) - 1] = 0;
    if (cell_scene(p->type, value, NULL, &s, NULL) == STATUS_OK)
        omitted = features_omitted(&s);
    scene_free(&s);
    return omitted;
}

static void assumed(FILE *to, const sweep_point *p)
{
    assumption a;
    for (int i = 0; assumptions_at(p, i, &a); i++)
        paragraph_write(to, fprintf(to, "%s: ", assumptions_kind(a.kind)), INDENT, a.text);
}

static void divided(FILE *to, const sweep_point *p)
{
    char words[FAULT_TEXT];
    division_words(&p->scene, 0, words, sizeof words);
    if (words[0] != '\0')
        paragraph_write(to, fprintf(to, "divided: "), INDENT, words);
}

void table_omitted(FILE *to, const sweep_point *p)
{
    assumed(to, p);
    divided(to, p);
    const int whole = case_omits_nothing(p->type, p->parameter);
    char words[SCENE_OMISSION_WORDS];
    scene_omission_words(whole ? omitted_by_source(p) : features_omitted(&p->scene), words);
    if (words[0] != '\0' && !whole)
        paragraph_write(to, fprintf(to, "omitted: "), INDENT, words);
    if (whole && words[0] == '\0')
        paragraph_printf(
            to, fprintf(to, "omitted: "), INDENT,
            "nothing; remove omit=none, which has no effect, to see the stored values");
    else if (whole)
        paragraph_printf(to, fprintf(to, "omitted: "), INDENT,
                         "nothing, whereas the source of the case omits %s; the stored values are "
                         "not shown, because they belong to that model",
                         words);
}

void table_theory(FILE *to, const scene *s, const element_type *type)
{
    const char *words = features_theory_words(type, features_theory(s, type));
    if (words[0] != '\0')
        paragraph_write(to, fprintf(to, "shear in stability: "), INDENT, words);
}

void table_series(FILE *to, const sweep *s, int index)
{
    const series *one = &s->series[index];
    const sweep_point *p = &s->point[one->point];
    char words[OMISSION_TEXT];
    fprintf(to, "%s%s%s%s, %s\n", p->type->name, p->text[0] != '\0' ? " (" : "", p->text,
            p->text[0] != '\0' ? ")" : "", one->formulation.key);
    omission_words(&one->without, words);
    if (words[0] != '\0')
        paragraph_write(to, 0, 2, words);
}

/* Returns the number of columns of a UTF-8 text with this number of bytes. */
static int columns_of(const char *text, size_t bytes)
{
    int columns = 0;
    for (size_t i = 0; i < bytes; i++)
        columns += ((unsigned char)text[i] & 0xc0) != 0x80;
    return columns;
}

int paragraph_columns(const char *text)
{
    return columns_of(text, strlen(text));
}

/* Returns the number of bytes of the next word. In commands, blanks within quotation marks belong
 * to the word. */
static size_t word_at(const char *text, int command)
{
    size_t length = strcspn(text, " \n'");
    if (!command)
        return strcspn(text, " \n");
    while (text[length] == '\'') {
        const char *end = strchr(text + length + 1, '\'');
        length = end != NULL ? (size_t)(end - text) + 1 : strlen(text);
        length += strcspn(text + length, " \n'");
    }
    return length;
}

/* Writes words with line breaks. joint: text at the end of a line that is continued. */
static void write_words(FILE *to, int at, int indent, const char *joint, const char *text)
{
    const int width = PARAGRAPH_WIDTH - columns_of(joint, strlen(joint));
    int column = at, begun = 0;
    static const char blank[] = " \n";
    for (text += strspn(text, blank); *text != '\0'; text += strspn(text, blank)) {
        const size_t word = word_at(text, joint[0] != '\0');
        const int wide = columns_of(text, word);
        if (begun && column + 1 + wide > width) {
            fputs(joint, to);
            fputc('\n', to);
            column = begun = 0;
        }
        const int blanks = begun ? 1 : column < indent ? indent - column : 0;
        for (int i = 0; i < blanks; i++)
            fputc(' ', to);
        fwrite(text, 1, word, to);
        column += blanks + wide;
        begun = 1;
        text += word;
    }
    fputc('\n', to);
}

void paragraph_write(FILE *to, int at, int indent, const char *text)
{
    write_words(to, at, indent, "", text);
}

FILE *paragraph_begin(paragraph *p, FILE *to)
{
    *p = (paragraph){.to = to};
    p->words = open_memstream(&p->text, &p->size);
    return p->words != NULL ? p->words : to;
}

static void end_with(paragraph *p, int at, int indent, const char *joint)
{
    if (p->words == NULL)
        fputc('\n', p->to);
    else if (fclose(p->words) == 0)
        write_words(p->to, at, indent, joint, p->text);
    free(p->text);
}

void paragraph_end(paragraph *p, int at, int indent)
{
    end_with(p, at, indent, "");
}

void paragraph_end_command(paragraph *p, int at, int indent)
{
    end_with(p, at, indent, " \\");
}

void paragraph_printf(FILE *to, int at, int indent, const char *format, ...)
{
    char *text = NULL;
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    if (vasprintf(&text, format, arguments) >= 0) {
        paragraph_write(to, at, indent, text);
        free(text);
    } else {
        fputc(' ', to);
        vfprintf(to, format, again);
        fputc('\n', to);
    }
    va_end(again);
    va_end(arguments);
}

static const char *const inks[] = {[SCREEN_PLAIN] = "",
                                   [SCREEN_GOOD] = "\033[32m",
                                   [SCREEN_BAD] = "\033[1;31m",
                                   [SCREEN_FAINT] = "\033[2m"};

static int has_colour(FILE *to)
{
    const char *terminal = getenv("TERM"), *none = getenv("NO_COLOR");
    return isatty(fileno(to)) && terminal != NULL && strcmp(terminal, "dumb") != 0 &&
           (none == NULL || none[0] == '\0');
}

static int has_utf8(void)
{
    const locale_t here = newlocale(LC_CTYPE_MASK, "", (locale_t)0);
    if (here == (locale_t)0)
        return 0;
    const int utf8 = strcmp(nl_langinfo_l(CODESET, here), "UTF-8") == 0;
    freelocale(here);
    return utf8;
}

screen screen_of(FILE *to)
{
    return (screen){.colour = has_colour(to), .utf8 = has_utf8()};
}

void screen_put(FILE *to, screen look, screen_ink ink, const char *text)
{
    const int painted = look.colour && ink != SCREEN_PLAIN;
    fprintf(to, "%s%s%s", painted ? inks[ink] : "", text, painted ? "\033[0m" : "");
}
