#include "harness/model/division_words.h"

#include <stdarg.h>
#include <stdio.h>

#include "cases/scene/names.h"
#include "harness/model/division.h"

enum { MOST_NAMES = 4, MOST_PLACES = 8 };

typedef struct words {
    char *text;
    size_t room, used;
} words;

__attribute__((format(printf, 2, 3))) static void put(words *w, const char *format, ...)
{
    va_list arguments;
    if (w->used >= w->room)
        return;
    va_start(arguments, format);
    w->used += (size_t)vsnprintf(w->text + w->used, w->room - w->used, format, arguments);
    va_end(arguments);
}

static void put_member(words *w, const scene *s, const division *d, int member)
{
    const int pieces = division_pieces(d, member);
    const double *place = &d->place[d->first[member] + member];
    put(w, "%s%s has ", w->used > 0 ? "; " : "", scene_name(s, SCENE_MEMBERS, member).text);
    if (d->each[member] == 0)
        put(w, "n elements ");
    else
        put(w, "%d elements, %d ", division_elements(d, member), d->each[member]);
    put(w, "in each of %d pieces: its loads begin, end or act at", pieces);
    for (int i = 1; i < pieces && i <= MOST_PLACES; i++)
        put(w, "%s %.6g", i > 1 ? "," : "", place[i]);
    put(w, "%s of its length", pieces - 1 > MOST_PLACES ? ", .." : "");
}

void division_words(const scene *s, int elements, char *text, size_t room)
{
    words w = {text, room, 0};
    division d = {0};
    int more = 0;
    text[0] = '\0';
    if (division_make(s, elements, &d, NULL) == STATUS_OK)
        for (int i = 0, named = 0; i < s->members; i++) {
            if (division_pieces(&d, i) == 1)
                continue;
            if (named++ < MOST_NAMES)
                put_member(&w, s, &d, i);
            else
                more++;
        }
    if (more > 0)
        put(&w, "; and %d more members", more);
    division_free(&d);
}
