#include "harness/cli/completion.h"

#include <string.h>

#include "cases/format/scene_file.h"
#include "harness/cli/names.h"
#include "harness/formulations/case_find.h"

enum { SAID = 400 };

/* What the words before the cursor say. */
typedef struct reading {
    const struct argp_option *chosen;
    const struct argp_option *open; /* the option whose value the word at the cursor is; or NULL */
    int only_arguments;             /* behind "--" */
    const char *last;               /* argument; NULL: none yet */
    int arguments;                  /* so many */
    const char *scene;              /* value of --scene */
    char said[SAID];                /* arguments, with a blank behind each */
} reading;

/* Of a whole name, or the beginning of one only. */
static const struct argp_option *long_option(const reading *r, const char *name, size_t length)
{
    const struct argp_option *found = NULL;
    int begun = 0;
    for (const struct argp_option *o = r->chosen; o->name != NULL; o++)
        if (strncmp(o->name, name, length) == 0) {
            if (o->name[length] == '\0')
                return o;
            found = o;
            begun++;
        }
    return begun == 1 ? found : NULL;
}

/* The option of "-Kf..." that takes a value, *rest behind its letter; NULL: none does. */
static const struct argp_option *short_option(const reading *r, const char *word, const char **rest)
{
    for (const char *letter = word + 1; *letter != '\0'; letter++)
        for (const struct argp_option *o = r->chosen; o->name != NULL; o++)
            if (o->key == *letter && o->arg != NULL) {
                *rest = letter + 1;
                return o;
            }
    return NULL;
}

static int is_optional(const struct argp_option *o)
{
    return (o->flags & OPTION_ARG_OPTIONAL) != 0;
}

static void keep_value(reading *r, const struct argp_option *o, const char *value)
{
    if (o != NULL && strcmp(o->name, "scene") == 0)
        r->scene = value;
}

static void read_option(reading *r, const char *word)
{
    const int is_long = word[1] == '-';
    const size_t length = is_long ? strcspn(word + 2, "=") : 0;
    const char *value = is_long ? word + 2 + length + (word[2 + length] == '=') : "";
    const struct argp_option *o =
        is_long ? long_option(r, word + 2, length) : short_option(r, word, &value);
    const int given = is_long ? word[2 + length] == '=' : value[0] != '\0';
    if (given)
        keep_value(r, o, value);
    else if (o != NULL && o->arg != NULL && !is_optional(o))
        r->open = o;
}

static void read_argument(reading *r, const char *word)
{
    const size_t used = strlen(r->said);
    r->last = word;
    r->arguments++;
    snprintf(r->said + used, sizeof r->said - used, "%s ", word);
}

static void read_word(reading *r, const char *word)
{
    if (r->open != NULL) {
        keep_value(r, r->open, word);
        r->open = NULL;
    } else if (!r->only_arguments && strcmp(word, "--") == 0) {
        r->only_arguments = 1;
    } else if (!r->only_arguments && word[0] == '-' && word[1] != '\0') {
        read_option(r, word);
    } else {
        read_argument(r, word);
    }
}

/* A term of several words may stand in several arguments, and in one. */
static void offer_words(const offer *o, const reading *r)
{
    const offer word = offer_behind(o, " ");
    const int here = (int)(word.begun - o->begun);
    char said[2 * SAID];
    snprintf(said, sizeof said, "%s%.*s", r->said, here < SAID ? here : 0, o->begun);
    names_words(&word, said);
}

/* Upper case: what it is called; else the word itself, of "exec:COMMAND" up to the colon. */
static void offer_part(const offer *o, const reading *r, const char *part)
{
    char word[40];
    if (strcmp(part, "CASE") == 0)
        names_cases(o);
    else if (strcmp(part, "FORMULATION") == 0)
        names_formulations(o);
    else if (strcmp(part, "WORD") == 0)
        offer_words(o, r);
    else if (strcmp(part, "FOLDER") == 0)
        offer_folders(o);
    else if (strncmp(part, "FILE", 4) == 0 || strcmp(part, "OLD") == 0 || strcmp(part, "NEW") == 0)
        offer_files(o);
    else if (part[0] >= 'a' && part[0] <= 'z') {
        const int all = (int)strcspn(part, ":");
        snprintf(word, sizeof word, "%.*s", all + (part[all] == ':'), part);
        offer_text(o, word, "");
    }
}

/* "[cases|formulations|CASE]", "FILE...", "text|json|csv". */
static void offer_kinds(const offer *o, const reading *r, const char *kinds)
{
    static const char between[] = "[]|. ";
    char part[40];
    for (kinds += strspn(kinds, between); *kinds != '\0'; kinds += strspn(kinds, between)) {
        const size_t length = strcspn(kinds, between);
        snprintf(part, sizeof part, "%.*s", (int)length, kinds);
        offer_part(o, r, part);
        kinds += length;
    }
}

/* One more than there are? "OLD [NEW]" are two, "CASE..." any number. */
static int takes_more(const reading *r, const char *arguments)
{
    int most = 1;
    for (const char *at = arguments; *at != '\0'; at++)
        most += *at == ' ';
    return strstr(arguments, "...") != NULL || r->arguments < most;
}

static void offer_selection(const offer *o)
{
    const offer word = offer_behind(o, " (");
    names_cases(&word);
    names_formulations(&word);
    offer_choices(&word, "and|or|not");
}

/* Of the case or scene file that the line names. */
static void offer_parameters(const offer *o, const reading *r,
                             void names(const offer *, const case_type *))
{
    scene_file *file = NULL;
    mistakes m;
    if (r->scene != NULL && scene_file_read(r->scene, &file, &m, NULL) == STATUS_OK)
        names(o, scene_file_case(file));
    else if (r->scene == NULL && r->last != NULL)
        names(o, case_find(r->last, NULL));
    scene_file_free(file);
}

static void offer_value(const offer *o, const reading *r, const struct argp_option *option)
{
    switch (option->key) {
    case 'f':
        names_formulation_options(o);
        break;
    case 's':
        offer_parameters(o, r, names_parameters);
        break;
    case 'V':
        offer_parameters(o, r, names_numbers);
        break;
    case 'k':
        offer_selection(o);
        break;
    case 'A':
        names_formulation_options(o);
        offer_files(o);
        break;
    default:
        offer_kinds(o, r, option->arg);
    }
}

static void offer_options(const offer *o, const reading *r)
{
    char text[80];
    for (const struct argp_option *one = r->chosen; one->name != NULL; one++) {
        snprintf(text, sizeof text, "--%s%s", one->name,
                 one->arg != NULL && !is_optional(one) ? "=" : "");
        offer_text(o, text, one->doc);
    }
}

/* "-Kf" or "--formulation=", and behind it the beginning of a value. */
static void offer_begun_option(FILE *to, const reading *r, const char *word)
{
    const offer whole = {to, word, 0, word};
    const size_t name = strcspn(word, "=");
    const char *value = NULL;
    const struct argp_option *o = NULL;
    if (strncmp(word, "--", 2) != 0)
        o = short_option(r, word, &value);
    else if (word[name] == '=')
        o = long_option(r, word + 2, name - 2), value = word + name + 1;
    const offer behind = {to, word, value != NULL ? (int)(value - word) : 0, value};
    if (o != NULL && o->arg != NULL)
        offer_value(&behind, r, o);
    else
        offer_options(&whole, r);
}

void completion_write(FILE *to, const help_subject *s, const void *context)
{
    const completion_line *line = context;
    const char *begun = line->word[line->count - 1];
    const offer whole = {to, begun, 0, begun};
    reading r = {.chosen = s->chosen};
    for (int i = 0; i + 1 < line->count; i++)
        read_word(&r, line->word[i]);
    if (r.open != NULL)
        offer_value(&whole, &r, r.open);
    else if (begun[0] == '-' && !r.only_arguments)
        offer_begun_option(to, &r, begun);
    else if (takes_more(&r, s->arguments))
        offer_kinds(&whole, &r, s->arguments);
}
