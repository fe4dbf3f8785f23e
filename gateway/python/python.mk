# The Python client with its generated module, in one folder that can be copied anywhere. pip takes gateway/python itself (setup.py).
CLIENT := $(wildcard gateway/python/tactus/*.py) gateway/python/tactus/py.typed
WHEELS := $(patsubst %,build/wheel/%-$(SEMVER)-py3-none-any.whl,tactus lerobot_robot_tactus)
PACK = $(Q)/usr/bin/python3 -m pip --isolated wheel --quiet --no-index --no-deps --no-build-isolation --wheel-dir $(@D)
.PHONY: python wheel
python: $(CLIENT:gateway/%=build/%) build/python/tactus/tactus_pb2.py      ## write the Python client into build/python
build/python/tactus/%: gateway/python/tactus/%
	$(call say,PY    $@)
	$(Q)install -D -m 644 $< $@
build/python/tactus/tactus_pb2.py: gateway/tactus.proto
	$(call say,PY    $@)
	$(Q)mkdir -p $(@D)
	$(Q)protoc -I$(<D) --python_out=$(@D) --pyi_out=$(@D) $<
wheel: setup-wheel $(WHEELS)                  ## pack the Python client and LeRobot's robot for pip, without a network: build/wheel
build/wheel/tactus-%: gateway/python/pyproject.toml gateway/python/setup.py $(CLIENT) gateway/tactus.proto
	$(call say,PIP   $@)
	$(PACK) $(<D)
build/wheel/lerobot_robot_tactus-%: gateway/python/lerobot/pyproject.toml gateway/python/lerobot/setup.py $(wildcard gateway/python/lerobot/*/*.py)
	$(call say,PIP   $@)
	$(PACK) $(<D)
$(filter $(B)/tests/gateway/python/test_%,$(TESTS)): | python $(WHEELS)
$(filter $(B)/tests/program/test_recording $(B)/tests/program/pages/test_tutorial $(B)/tests/gateway/ctl/test_%,$(TESTS)): | python
