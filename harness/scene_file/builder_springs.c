/* Springs of a scene file. */
#include <string.h>

#include "harness/scene_file/builder.h"

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
        scene_add_spring(b->scene, p, q, stiffness);
    }
}
