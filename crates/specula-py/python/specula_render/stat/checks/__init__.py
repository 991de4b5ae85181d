"""The checks, one a file. Each has the public function and `of_trial`, which `prove` calls."""
