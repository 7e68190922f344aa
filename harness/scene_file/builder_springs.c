/* Springs of a scene file. */
#include <string.h>

#include "harness/scene_file/builder.h"

/* In a part that is turned the stiffness is in its axes: K <- T K T^T, T = diag(R, R). */
static void turn_stiffness(const placement *placed, double K[36])
{
    double turned[36];
    if (placed == NULL || !placed->turned)
        return;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < 36; i += 3)
            placement_turn(placed, &K[i]);
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < 6; j++)
                turned[6 * i + j] = K[6 * j + i];
        memcpy(K, turned, sizeof turned);
    }
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            K[6 * i + j] = (turned[6 * i + j] + turned[6 * j + i]) / 2;
}

void builder_springs(builder *b)
{
    for (int i = 0; i < b->list[LIST_SPRINGS].count; i++) {
        const fields f = fields_of(b, &b->list[LIST_SPRINGS].entry[i]);
        const int p = fields_entry(&f, "from", LIST_NODES), q = fields_entry(&f, "to", LIST_NODES);
        double *given, stiffness[36] = {0};
        const int count = fields_values(&f, "stiffness", &given);
        if (count == 36)
            memcpy(stiffness, given, sizeof stiffness);
        if (count == 6)
            for (int k = 0; k < 6; k++)
                stiffness[7 * k] = given[k];
        if (count != 6 && count != 36)
            document_mistake(b->mistakes, document_find(f.map, "stiffness"), 0,
                             "stiffness: %d numbers; give six, or the 36 of a matrix", count);
        else
            turn_stiffness(f.placed, stiffness);
        scene_add_spring(b->scene, p, q, stiffness);
    }
}
