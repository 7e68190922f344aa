#include "harness/newton/system_matrices.h"

#include <stdlib.h>
#include <string.h>

void system_matrices_free(system_matrices *s)
{
    for (int i = 0; i < s->states; i++) {
        triplets *const each[] = {&s->state[i].K, &s->state[i].M, &s->state[i].G,
                                  &s->state[i].inside, &s->state[i].B};
        for (size_t k = 0; k < sizeof each / sizeof *each; k++)
            triplets_free(each[k]);
        free(s->state[i].frequency);
        free(s->state[i].mode);
    }
    free(s->state);
    free(s->label);
    memset(s, 0, sizeof *s);
}
