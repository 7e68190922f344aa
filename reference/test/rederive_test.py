"""What `make truths` runs is what derives exact rows, and each of them is stored."""
import inspect
import unittest

from reference.derive import rederive


class Programs(unittest.TestCase):

    def test_each_takes_no_more_than_whether_all_are_wanted(self):
        """A program of another kind that calls a function rows() would be taken for one of these."""
        for name in rederive.programs([]):
            module = rederive.importlib.import_module(f"reference.derive.{name}")
            wanted = ["everything"] if rederive.is_solid(name) else []
            self.assertEqual(list(inspect.signature(module.rows).parameters), wanted, name)

    def test_a_name_that_is_none(self):
        with self.assertRaisesRegex(SystemExit, "no program 'rotor'"):
            rederive.programs(["rotor"])


if __name__ == "__main__":
    unittest.main()
