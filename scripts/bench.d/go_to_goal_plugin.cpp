// The control module as a plugin. Compared with the built-in control, it measures the overhead of a plugin.
#include "avoidance/go_to_goal.h"
#include "avoidance/plugin.h"

HEDGEHOP_PLUGIN(
    hedgehop::avoidance::ModuleRow<hedgehop::avoidance::GoToGoalConfig, hedgehop::avoidance::make_go_to_goal>)
