#!/bin/sh
# status.sh JOB: what Snakemake asks by --cluster-status of a Slurm job: running (also when it only
# waits, requeued or not), success or failed.
job=${1%%;*} # sbatch --parsable says "job;cluster" where there are several

if ! jobs=$(squeue --me --noheader --states=all --format='%A %T' 2>/dev/null); then
  echo running # the controller is busy or away, which says nothing of the job
  exit
fi
state=$(echo "$jobs" | awk -v job="$job" '$1 == job { print $2 }')
# The controller forgets a job some minutes after its end; the accounting, where there is one, does
# not. A job nobody knows has failed: running it again costs little, it goes on from its journal.
if [ -z "$state" ]; then
  state=$(sacct --noheader --allocations --parsable2 --format=State --jobs="$job" 2>/dev/null)
fi

case $state in
  COMPLETED) echo success ;;
  PENDING | RUNNING | CONFIGURING | COMPLETING | SUSPENDED | STOPPED | SIGNALING | STAGE_OUT | \
    RESIZING | RESV_DEL_HOLD | REQUEUED | REQUEUE_FED | REQUEUE_HOLD | SPECIAL_EXIT) echo running ;;
  *) echo failed ;;
esac
