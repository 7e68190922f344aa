#include "cases/format/meaning.h"

#include <stdio.h>
#include <string.h>

#include "cases/format/meaning_impl.h"
#include "cases/scene/quantity_type.h"

/* Without the name of its analysis. */
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
        fputs(", with the other sign", to);
    else if (q->factor != 1)
        fprintf(to, ", times %.10g", q->factor);
    if (q->offset != 0)
        fprintf(to, ", plus %.10g", q->offset);
    fclose(to);
    text[size - 1] = '\0';
}

/* Does another analysis of the same kind answer in the same words? */
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
