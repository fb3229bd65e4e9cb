; press the lid on
        TRANS   T [20 28 8 90 90 0]
        TRANS   PARK [20 30 12 90 90 0]
        STAGE   "press the lid"
        MOVE    T
        STOP    [0 0 -60]
        CHANGE  [0 0 -1]
        SKIPN   23
        WAIT    "there is no lid"
        PARK
