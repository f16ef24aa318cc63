// The control, as a module from outside: beside the one of the tree it measures what a plugin costs.
#include "avoidance/go_to_goal.h"
#include "avoidance/plugin.h"

HEDGEHOP_PLUGIN(
    hedgehop::avoidance::ModuleRow<hedgehop::avoidance::GoToGoalConfig, hedgehop::avoidance::make_go_to_goal>)
