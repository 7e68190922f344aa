#include "cases/scene/function.h"

#include <stdlib.h>
#include <string.h>

int function_add(scene_function *to, double until, const char *text)
{
    scene_piece *longer = realloc(to->piece, ((size_t)to->pieces + 1) * sizeof *longer);
    if (longer == NULL)
        return -1;
    fault ignored;
    to->piece = longer;
    scene_piece *p = &to->piece[to->pieces];
    *p = (scene_piece){until, strdup(text), NULL};
    if (p->text == NULL)
        return -1;
    formula_read(text, &p->is, &ignored);
    to->pieces++;
    return 0;
}

void function_free(scene_function *f)
{
    for (int i = 0; i < f->pieces; i++) {
        free(f->piece[i].text);
        formula_free(f->piece[i].is);
    }
    free(f->piece);
    *f = (scene_function){0, NULL, 0};
}

status function_check(const scene_function *s, fault *f)
{
    for (int i = 0; i < s->pieces; i++) {
        formula *again = NULL;
        if (s->piece[i].is == NULL) {
            TRY(formula_read(s->piece[i].text, &again, f));
            formula_free(again);
            return fault_set(f, STATUS_FAULT, "out of memory for a function of time");
        }
        if (i > 0 && !(s->piece[i].until > s->piece[i - 1].until))
            return fault_set(f, STATUS_REFUSED,
                             "a function of time in pieces: the end of piece %d, %g s, is not "
                             "behind that of the one before",
                             i + 1, s->piece[i].until);
    }
    return STATUS_OK;
}

void function_at(const scene_function *f, double t, double out[3])
{
    int i = 0;
    while (i < f->pieces - 1 && t >= f->piece[i].until)
        i++;
    formula_at(f->piece[i].is, t, out);
    for (int k = 0; k < 3 && f->scale != 0; k++)
        out[k] *= f->scale;
}
