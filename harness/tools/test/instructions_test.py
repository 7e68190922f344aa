"""Parts of a profile: each instruction is in one, whoever calls whom; operations by address."""
import unittest

from harness.tools.kit.program import ProgramTest
from harness.tools.instructions import Profile, operations, parts_of

# Newton's loop calls strain twice and a factor once; strain has a product of its own; the set-up
# evaluates a strain too, as its own work.
PROFILE = """# callgrind format
positions: instr line
events: Ir

ob=(1) /there/build/beamwork
fl=(1) harness/newton/newton.c
fn=(1) newton_to
0x100 10 5
+4 11 7
cfi=(2) /old/place/elements/sheet/third.c
cfn=(2) third_strain
calls=2 0x200 1
* 12 60
cfi=(3) harness/numerics/factor.c
cfn=(3) factor_numeric
calls=1 0x300 1
+4 13 20
cfi=(4) harness/model/model.c
cfn=(4) model_alloc
calls=1 0x400 1
+4 14 33

fl=(2)
fn=(2)
0x200 1 50
+4 2 16
cfi=(5) elements/math/dense.c
cfn=(5) dense_add_congruence
calls=3 0x500 1
+8 3 24

fl=(5)
fn=(5)
0x500 1 24

fl=(3)
fn=(3)
0x300 1 8
cob=(2) /lib/libldl.so
cfi=(6) ???
cfn=(6) ldl_numeric
calls=1 0x200 0
+4 2 12

ob=(2)
fl=(6)
fn=(6)
0x200 0 12

ob=(1)
fl=(4)
fn=(4)
0x400 1 3
cfi=(2)
cfn=(2)
calls=1 0x200 1
-4 2 30
"""


class Parts(ProgramTest):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "profile"
        self.path.write_text(PROFILE, encoding="ascii")

    def test_parts(self):
        parts = parts_of(Profile(self.path))
        self.assertEqual(dict(parts), {"strain": 60, "factorisation": 20, "set-up": 33, "rest": 12})

    def test_operations(self):
        """Two addresses of the program; the library has instructions at one of them too."""
        numbers = {0x200: 4, 0x204: 1, 0x104: 2, 0x3fc: 1}
        self.assertEqual(operations(self.path, "/there/build/beamwork", numbers),
                         4 * 50 + 16 + 2 * 7)


if __name__ == "__main__":
    unittest.main()
