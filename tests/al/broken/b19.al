; a dowel of three eighths, from the rack to the plate
        TRANS   RACK [24 32 7 90 90 0]
        TRANS   PLATE [25 38 4 90 90 0]
        OPEN    .2
        MOVE    RACK
        CLOSE   .25 .5          ;it is .375 in thick
        SKIPN   2
        WAIT    "no dowel in the rack"
        MOVE    PLATE
        PLACE
        OPEN    2
        CHANGE  Z 2
